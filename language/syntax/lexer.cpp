// Text to tokens.
#include <algorithm>
#include <array>
#include <iterator>

#include "language/syntax/token.h"
#include "language/units.h"
#include "text/display.h"
#include "text/utf8.h"

namespace hookpoint::language {
namespace {

bool is_digit(char c) { return c >= '0' && c <= '9'; }
bool is_name_start(char c) { return (c >= 'a' && c <= 'z') || (c >= 'A' && c <= 'Z') || c == '_'; }
bool is_name(char c) { return is_name_start(c) || is_digit(c); }

/// Two characters that are one symbol, `end` if they are none.
TokenKind pair_kind(char first, char second) {
  if (second == '=') {
    if (first == '<') return TokenKind::less_equal;
    if (first == '>') return TokenKind::greater_equal;
    if (first == '=') return TokenKind::equal;
    if (first == '!') return TokenKind::not_equal;
  }
  if (first != second) return TokenKind::end;
  if (first == '.') return TokenKind::range;
  if (first == '&') return TokenKind::and_operator;
  return first == '|' ? TokenKind::or_operator : TokenKind::end;
}

/// The kind of each character that is a symbol by itself, `end` for the others.
constexpr std::array<TokenKind, 256> single_kinds = [] {
  std::array<TokenKind, 256> kinds{};
  kinds.fill(TokenKind::end);
  constexpr std::string_view symbols = "{}()[];,.=+-*/^<>!?:";
  constexpr TokenKind in_order[] = {TokenKind::open_brace,
                                    TokenKind::close_brace,
                                    TokenKind::open_parenthesis,
                                    TokenKind::close_parenthesis,
                                    TokenKind::open_bracket,
                                    TokenKind::close_bracket,
                                    TokenKind::semicolon,
                                    TokenKind::comma,
                                    TokenKind::dot,
                                    TokenKind::assign,
                                    TokenKind::plus,
                                    TokenKind::minus,
                                    TokenKind::star,
                                    TokenKind::slash,
                                    TokenKind::caret,
                                    TokenKind::less,
                                    TokenKind::greater,
                                    TokenKind::not_operator,
                                    TokenKind::question,
                                    TokenKind::colon};
  static_assert(std::size(in_order) == symbols.size());
  for (std::size_t i = 0; i < symbols.size(); ++i)
    kinds[static_cast<unsigned char>(symbols[i])] = in_order[i];
  return kinds;
}();

class Lexer {
 public:
  Lexer(const SourceFile& file, bool comments, Report& report)
      : file_(file), text_(file.text), comments_(comments), report_(report) {}

  std::vector<Token> run() {
    tokens_.reserve(text_.size() / 4 + 1);
    if (text_.starts_with("\xEF\xBB\xBF")) at_ = 3;
    while (skip_blanks()) next();
    tokens_.push_back({TokenKind::end, true, static_cast<std::uint32_t>(text_.size()), 0});
    return std::move(tokens_);
  }

 private:
  char peek(std::size_t ahead) const {
    return at_ + ahead < text_.size() ? text_[at_ + ahead] : '\0';
  }

  bool skip_blanks() {
    for (; at_ < text_.size(); ++at_) {
      if (text_[at_] == '\n') {
        line_begins_ = true;
      } else if (text_[at_] != ' ' && text_[at_] != '\t' && text_[at_] != '\r' &&
                 text_[at_] != '\f' && text_[at_] != '\v') {
        return true;
      }
    }
    return false;
  }

  void next() {
    const char c = text_[at_];
    if (is_name_start(c)) {
      add(TokenKind::identifier, name_length(at_));
    } else if (c == '.' && begins_numbered_part()) {
      symbol();
      add(TokenKind::identifier, name_length(at_));
    } else if (is_digit(c) || (c == '.' && is_digit(peek(1)))) {
      add(TokenKind::number, number_length());
    } else if (c == '"') {
      text();
    } else if (c == '/' && (peek(1) == '/' || peek(1) == '*')) {
      comment();
    } else {
      symbol();
    }
  }

  std::size_t name_length(std::size_t from) const {
    std::size_t end = from + 1;
    while (end < text_.size() && is_name(text_[end])) ++end;
    return end - from;
  }

  /// A dot right behind a name, and a part that begins with digits: Plot.3D. No number stands
  /// there.
  bool begins_numbered_part() const {
    if (tokens_.empty() || tokens_.back().kind != TokenKind::identifier || !is_digit(peek(1)))
      return false;
    const Token& name = tokens_.back();
    const std::string_view part = text_.substr(at_ + 1, name_length(at_ + 1));
    return name.offset + name.length == at_ && !std::ranges::all_of(part, is_digit);
  }

  /// Digits, then a unit on the same line.
  std::size_t number_length() const {
    const std::size_t digits = digits_length(text_.substr(at_));
    const std::optional<ScannedUnit> unit = scan_unit(text_.substr(at_ + digits));
    return digits + (unit ? unit->length : 0);
  }

  void text() {
    std::size_t end = at_ + 1;
    while (end < text_.size() && text_[end] != '"' && text_[end] != '\n') {
      end += text_[end] == '\\' && end + 1 < text_.size() && text_[end + 1] != '\n' ? 2 : 1;
    }
    const bool closed = end < text_.size() && text_[end] == '"';
    if (!closed) error(at_, 1, "this string has no closing `\"` on its line");
    add(TokenKind::text, (closed ? end + 1 : std::min(end, text_.size())) - at_);
  }

  void comment() {
    std::size_t end = 0;
    if (peek(1) == '/') {
      end = std::min(text_.find('\n', at_), text_.size());
      if (text_[end - 1] == '\r') --end;
    } else {
      end = text_.find("*/", at_ + 2);
      if (end == std::string_view::npos) {
        error(at_, 2, "this comment has no end: expected `*/`");
        end = text_.size();
      } else {
        end += 2;
      }
    }
    const bool lines = text_.substr(at_, end - at_).find('\n') != std::string_view::npos;
    if (comments_) {
      add(TokenKind::comment, end - at_);
    } else {
      at_ = end;
    }
    line_begins_ = line_begins_ || lines;
  }

  void symbol() {
    const TokenKind pair = pair_kind(text_[at_], peek(1));
    if (pair != TokenKind::end) return add(pair, 2);
    const TokenKind single = single_kinds[static_cast<unsigned char>(text_[at_])];
    if (single != TokenKind::end) return add(single, 1);
    // One error for a run of characters that mean nothing, however long.
    std::size_t end = at_ + 1;
    while (end < text_.size() && static_cast<unsigned char>(text_[end]) >= 0x80) ++end;
    constexpr std::size_t longest = 24;
    error(at_, end - at_,
          "unexpected `" +
              std::string(text::first_characters(text_.substr(at_, end - at_), longest)) + "`");
    add(TokenKind::unknown, end - at_);
  }

  void add(TokenKind kind, std::size_t length) {
    tokens_.push_back(
        {kind, line_begins_, static_cast<std::uint32_t>(at_), static_cast<std::uint32_t>(length)});
    line_begins_ = false;
    at_ += length;
  }

  void error(std::size_t offset, std::size_t length, std::string message) {
    report_.error({&file_, offset, length}, std::move(message));
  }

  const SourceFile& file_;
  std::string_view text_;
  bool comments_;
  Report& report_;
  std::vector<Token> tokens_;
  std::size_t at_ = 0;
  bool line_begins_ = true;
};

}  // namespace

std::size_t digits_length(std::string_view text) {
  std::size_t end = 0;
  while (end < text.size() && is_digit(text[end])) ++end;
  const bool range = end + 1 < text.size() && text[end] == '.' && text[end + 1] == '.';
  if (end < text.size() && text[end] == '.' && !range) {
    ++end;
    while (end < text.size() && is_digit(text[end])) ++end;
  }
  if (end < text.size() && (text[end] == 'e' || text[end] == 'E')) {
    std::size_t exponent = end + 1;
    if (exponent < text.size() && (text[exponent] == '+' || text[exponent] == '-')) ++exponent;
    if (exponent < text.size() && is_digit(text[exponent])) {
      while (exponent < text.size() && is_digit(text[exponent])) ++exponent;
      end = exponent;
    }
  }
  return end;
}

bool check_text(const SourceFile& file, Report& report) {
  constexpr std::size_t largest = 256UL << 20;
  const std::string& text = file.text;
  if (text.size() > largest) {
    report.error({&file, 0, 1}, "the file is larger than 256 MiB");
    return false;
  }
  for (std::size_t i = 0; i < text.size();) {
    const auto c = static_cast<unsigned char>(text[i]);
    if (c >= 0x80) {
      const std::size_t length = text::first_character(std::string_view(text).substr(i)).length;
      if (length == 0) {
        report.error({&file, i, 1}, "the file is not a text file in UTF-8: unexpected byte here");
        return false;
      }
      i += length;
      continue;
    }
    if ((c < 0x20 && (c < '\t' || c > '\r')) || c == 0x7F) {
      report.error({&file, i, 1}, "the file is not a text file: unexpected control character " +
                                      std::to_string(c));
      return false;
    }
    ++i;
  }
  return true;
}

bool is_object_name(std::string_view word) {
  return !word.empty() && is_name_start(word[0]) && std::ranges::all_of(word, is_name) &&
         std::ranges::find(reserved_words, word) == std::end(reserved_words);
}

std::vector<Token> tokenize(const SourceFile& file, bool comments, Report& report) {
  return Lexer(file, comments, report).run();
}

}  // namespace hookpoint::language
