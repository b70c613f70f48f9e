#include "language/syntax/format.h"

#include <algorithm>
#include <memory>

#include "language/syntax/syntax.h"
#include "language/syntax/token.h"

namespace hookpoint::language {
namespace {

constexpr std::size_t widest = 120;

/// An item as its tokens: what comes before `;` or `{`, and what stands inside the braces.
struct Element {
  std::vector<Token> before;    ///< comments on lines of their own above it
  std::vector<Token> head;      ///< with the comments inside it
  std::vector<Token> trailing;  ///< comments behind it on its last line
  std::vector<Token> opening;   ///< comments behind its `{`
  std::vector<Element> inside;
  bool block = false;
  bool closing = false;     ///< no item: the comments before a `}` or the end
  bool begins_line = true;  ///< stood on a line of its own
  bool one_line = true;     ///< its braces stood on one line
};

class Formatter {
 public:
  explicit Formatter(const SourceFile& file, std::vector<Token> tokens)
      : file_(file), tokens_(std::move(tokens)) {}

  std::string run() {
    const std::vector<Element> elements = read_elements();
    lay_elements(elements, 0);
    return std::move(text_);
  }

 private:
  const Token& token() const { return tokens_[at_]; }
  bool at(TokenKind kind) const { return token().kind == kind; }

  std::vector<Element> read_elements() {
    std::vector<Element> elements;
    while (true) {
      Element element;
      std::swap(element.before, below_);
      while (at(TokenKind::comment)) element.before.push_back(tokens_[at_++]);
      if (at(TokenKind::end) || at(TokenKind::close_brace)) {
        element.closing = true;
        if (!element.before.empty()) elements.push_back(std::move(element));
        return elements;
      }
      read_element(element);
      // A lone `;` says nothing.
      if (!element.head.empty() || !element.before.empty() || !element.trailing.empty())
        elements.push_back(std::move(element));
    }
  }

  void read_element(Element& element) {
    element.begins_line = token().begins_line;
    while (!at(TokenKind::semicolon) && !at(TokenKind::open_brace))
      element.head.push_back(tokens_[at_++]);
    const Token mark = tokens_[at_++];
    element.block = mark.kind == TokenKind::open_brace;
    // Comments just before the `;` or `{` move behind it.
    std::vector<Token>& behind = element.block ? element.opening : element.trailing;
    const auto not_comment = [](const Token& inner) { return inner.kind != TokenKind::comment; };
    const auto last = std::find_if(element.head.rbegin(), element.head.rend(), not_comment).base();
    behind.assign(last, element.head.end());
    element.head.erase(last, element.head.end());
    if (element.block) {
      read_trailing(element.opening);
      const std::size_t first = at_;
      element.inside = read_elements();
      const auto breaks = [](const Token& inner) {
        return inner.begins_line || inner.kind == TokenKind::comment;
      };
      element.one_line =
          element.opening.empty() && !mark.begins_line &&
          std::none_of(tokens_.begin() + static_cast<std::ptrdiff_t>(first),
                       tokens_.begin() + static_cast<std::ptrdiff_t>(at_ + 1), breaks);
      ++at_;
    }
    read_trailing(element.trailing);
  }

  /// Adds the comments on the rest of the line. What follows one of several lines stands below it,
  /// on a line of its own.
  void read_trailing(std::vector<Token>& comments) {
    while (at(TokenKind::comment) && !token().begins_line) comments.push_back(tokens_[at_++]);
    const auto many_lines = [this](const Token& comment) {
      return text_of(file_, comment).find('\n') != std::string_view::npos;
    };
    const auto first = std::ranges::find_if(comments, many_lines);
    if (first == comments.end()) return;
    below_.assign(first + 1, comments.end());
    comments.erase(first + 1, comments.end());
  }

  void lay_elements(const std::vector<Element>& elements, int depth) {
    const Element* previous = nullptr;
    for (const Element& element : elements) {
      for (const Token& comment : element.before) {
        separate(comment, previous != nullptr || &comment != element.before.data());
        line(depth, text_of_comment(comment));
      }
      if (element.closing) return;
      const bool first = previous == nullptr && element.before.empty();
      if (!element.head.empty()) separate(element.head.front(), !first);
      const bool joins = previous != nullptr && !element.begins_line && element.before.empty() &&
                         plain(*previous) && plain(element);
      lay_element(element, depth, joins);
      previous = &element;
    }
  }

  /// Fields and objects without a block, which may share a line.
  static bool plain(const Element& element) {
    return !element.block && element.trailing.empty() && !element.head.empty() &&
           std::ranges::none_of(
               element.head, [](const Token& token) { return token.kind == TokenKind::comment; });
  }

  void lay_element(const Element& element, int depth, bool joins) {
    const std::string head = head_text(element, depth);
    if (!element.block) {
      const std::string item = head.empty() ? "" : head + ';';
      const std::size_t line_begin = text_.rfind('\n', text_.empty() ? 0 : text_.size() - 2) + 1;
      const std::size_t width = text_.size() - 1 - line_begin + 1 + item.size();
      if (joins && width <= widest && item.find('\n') == std::string::npos) {
        text_.back() = ' ';
        text_ += item + '\n';
      } else if (!item.empty()) {
        line(depth, item);
      }
    } else if (element.inside.empty() && element.opening.empty()) {
      line(depth, head + " {}");
    } else if (const std::string whole = one_line_text(element, head);
               !whole.empty() && static_cast<std::size_t>(2 * depth) + whole.size() <= widest) {
      line(depth, whole);
    } else {
      line(depth, head + " {");
      append_trailing(element.opening, depth);
      lay_elements(element.inside, depth + 1);
      line(depth, "}");
    }
    append_trailing(element.trailing, depth);
  }

  /// The block on one line, "" when it stood on several or holds a comment.
  std::string one_line_text(const Element& element, const std::string& head) const {
    if (!element.one_line) return "";
    std::string text = head + " {";
    for (const Element& inner : element.inside) {
      const std::string inner_head = head_text(inner, 0);
      text += ' ' + (inner.inside.empty() ? inner_head + (inner.block ? " {}" : ";")
                                          : one_line_text(inner, inner_head));
    }
    return text + " }";
  }

  void append_trailing(const std::vector<Token>& comments, int depth) {
    for (const Token& comment : comments) {
      if (text_.empty()) {
        line(depth, text_of_comment(comment));
        continue;
      }
      text_.pop_back();
      text_ += "  " + text_of_comment(comment) + '\n';
    }
  }

  void line(int depth, const std::string& text) {
    text_ += std::string(static_cast<std::size_t>(2 * depth), ' ') + text + '\n';
  }

  /// One empty line where the file has any.
  void separate(const Token& token, bool wanted) {
    std::size_t lines = 0;
    for (std::size_t i = token.offset;
         i > 0 && std::string_view(" \t\r\n\f\v").find(file_.text[i - 1]) != std::string_view::npos;
         --i) {
      lines += file_.text[i - 1] == '\n' ? 1 : 0;
    }
    if (wanted && lines > 1 && !text_.empty()) text_ += '\n';
  }

  std::string text_of_comment(const Token& comment) const {
    std::string text(text_of(file_, comment));
    text.erase(std::remove(text.begin(), text.end(), '\r'), text.end());
    while (text.back() == ' ' || text.back() == '\t') text.pop_back();
    return text;
  }

  /// On one line where it fits, else with the lines that it came in.
  std::string head_text(const Element& element, int depth) const {
    const std::string text = head_text(element.head, depth, false);
    const std::size_t mark = element.block ? 2 : 1;  // ` {` or `;`
    const bool fits = static_cast<std::size_t>(2 * depth) + text.size() + mark <= widest;
    const bool commented = text.find('\n') != std::string::npos;
    return fits || commented ? text : head_text(element.head, depth, true);
  }

  std::string head_text(const std::vector<Token>& head, int depth, bool keep_lines) const {
    std::string text;
    const Token* previous = nullptr;
    bool unary = false;
    for (const Token& token : head) {
      const bool after_comment =
          previous != nullptr && previous->kind == TokenKind::comment && breaks_line(*previous);
      const bool broken = after_comment || (keep_lines && previous != nullptr && token.begins_line);
      if (broken) {
        text += '\n' + std::string(static_cast<std::size_t>(2 * depth + 4), ' ');
      } else if (previous != nullptr && !unary && spaced(*previous, token)) {
        text += ' ';
      }
      unary = is_sign(token) && (previous == nullptr || !ends_operand(*previous));
      text += token.kind == TokenKind::comment ? text_of_comment(token) : token_text(token);
      previous = &token;
    }
    return text;
  }

  bool breaks_line(const Token& comment) const { return text_of(file_, comment).starts_with("//"); }

  static bool is_sign(const Token& token) {
    return token.kind == TokenKind::minus || token.kind == TokenKind::plus ||
           token.kind == TokenKind::not_operator;
  }

  bool ends_operand(const Token& token) const {
    if (token.kind == TokenKind::identifier && text_of(file_, token) == "in") return false;
    return token.kind == TokenKind::identifier || token.kind == TokenKind::number ||
           token.kind == TokenKind::text || token.kind == TokenKind::close_parenthesis ||
           token.kind == TokenKind::close_bracket || token.kind == TokenKind::comment;
  }

  bool spaced(const Token& previous, const Token& next) const {
    const auto is = [](const Token& token, std::initializer_list<TokenKind> kinds) {
      return std::ranges::find(kinds, token.kind) != kinds.end();
    };
    using enum TokenKind;
    if (previous.kind == comment || next.kind == comment) return true;
    // `1. .. 2`: without the blank the dots would be read otherwise.
    if (next.kind == range) return text_of(file_, previous).ends_with('.');
    if (is(previous, {open_parenthesis, open_bracket, dot, caret, range})) return false;
    if (is(next, {comma, close_parenthesis, open_bracket, close_bracket, dot, caret})) return false;
    return !(next.kind == open_parenthesis && previous.kind == identifier);
  }

  /// A number's unit stands one blank behind it and holds none.
  std::string token_text(const Token& token) const {
    const std::string_view source = text_of(file_, token);
    if (token.kind != TokenKind::number) return std::string(source);
    std::string text;
    for (const char c : source) {
      if (c != ' ' && c != '\t') text += c;
    }
    const std::size_t digits = digits_length(text);
    if (digits < text.size()) text.insert(digits, " ");
    return text;
  }

  const SourceFile& file_;
  std::vector<Token> tokens_;
  std::size_t at_ = 0;
  std::vector<Token> below_;  ///< comments for the next element
  std::string text_;
};

}  // namespace

std::string format(const std::filesystem::path& file, const std::string& text,
                   Diagnostics& diagnostics) {
  // The diagnostics point into the text, so they keep it.
  const auto kept = std::make_shared<const SourceFile>(source_file(file.string(), text));
  ParsedFile parsed{*kept};
  parse(parsed);
  diagnostics.keep(kept);
  parsed.report.deliver(diagnostics);
  if (parsed.report.has_errors()) return text;
  Report none;
  return Formatter(parsed.source, tokenize(parsed.source, true, none)).run();
}

}  // namespace hookpoint::language
