#include "language/syntax/parser.h"

#include <algorithm>
#include <optional>

#include "text/display.h"

namespace hookpoint::language {
namespace {

/// Where the text shows that it is of another kind of file, of which each line would be wrong: under another
/// ending its first character is one that no name or comment begins with.
std::optional<std::size_t> foreign_at(const SourceFile& source) {
  constexpr std::string_view others = "#<>[](){}|!\"'$%&*+-.,:;=?@\\^`~0123456789";
  const std::size_t first = source.text.find_first_not_of(" \t\r\n");
  const bool foreign = !source.path.ends_with(".hook") && first != std::string::npos &&
                       others.find(source.text[first]) != std::string_view::npos;
  return foreign ? std::optional(first) : std::nullopt;
}

}  // namespace

Parser::Parser(ParsedFile& file) : file_(file), syntax_(file.syntax) {
  if (check_text(file.source, file.report)) {
    tokens_ = tokenize(file.source, false, file.report);
    swallowed_ = file.report.has_errors();
  } else {
    stopped_ = true;
    tokens_ = {{TokenKind::end, true, 0, 0}};
  }
}

void Parser::parse_file() {
  std::vector<Item> items;
  while (!stopped_ && !at(TokenKind::end)) {
    parse_items(items);
    if (!stopped_ && at(TokenKind::close_brace)) {
      fail(token(), "this `}` closes nothing");
      ++at_;
    }
  }
  if (items.empty() && !file_.report.has_errors()) {
    file_.report.error({&file_.source, 0, 1},
                       "the file describes nothing: expected at least one object");
  }
  syntax_.top = store(items);
}

void Parser::parse_override() {
  Item item;
  item.kind = ItemKind::assignment;
  if (stopped_) return;
  const Token& first = token();
  Trail trail;
  if (!parse_trail(trail)) return;
  item.place = span(first);
  detail_of(item).to = trail;
  if (!expect(TokenKind::assign, "`=` and a value") || !parse_value(item.value)) return;
  if (!at(TokenKind::end)) {
    fail_here("nothing after the value");
    return;
  }
  std::vector<Item> items{item};
  syntax_.top = store(items);
}

const Token& Parser::token(std::size_t ahead) const {
  return tokens_[std::min(at_ + ahead, tokens_.size() - 1)];
}

bool Parser::at_word(std::string_view word, std::size_t ahead) const {
  return at(TokenKind::identifier, ahead) && text(token(ahead)) == word;
}

bool Parser::at_keyword(std::size_t ahead) const {
  return at(TokenKind::identifier, ahead) &&
         std::ranges::find(reserved_words, text(token(ahead))) != std::end(reserved_words);
}

bool Parser::accept(TokenKind kind) {
  if (!at(kind)) return false;
  ++at_;
  return true;
}

bool Parser::expect(TokenKind kind, std::string_view what) {
  return accept(kind) || fail_here(what);
}

bool Parser::expect_semicolon(std::string_view after) {
  if (accept(TokenKind::semicolon)) return true;
  const Token& previous = tokens_[at_ - 1];
  const bool broken_text =
      previous.kind == TokenKind::text && (previous.length == 1 || !text(previous).ends_with('"'));
  if (broken_text) return true;
  const bool line_ended = token().begins_line || at(TokenKind::close_brace);
  if (!line_ended) return fail_here("`;` after " + std::string(after));
  file_.report.error({&file_.source, previous.offset + previous.length, 1},
                     "expected `;` after " + std::string(after));
  return true;
}

bool Parser::enter() {
  if (++depth_ <= deepest) return true;
  fail(token(), "nested deeper than " + std::to_string(deepest) + " levels");
  stopped_ = true;
  return false;
}

bool Parser::fail(const Token& where, std::string message) {
  if (!stopped_) file_.report.error(position(where), std::move(message));
  stopped_ = stopped_ || file_.report.full();
  return false;
}

bool Parser::fail_here(std::string_view expected) {
  if (at(TokenKind::unknown) || (at(TokenKind::end) && swallowed_))
    return false;  // the lexer has said so
  if (at(TokenKind::end) && !open_braces_.empty()) {
    fail(token(), "expected " + std::string(expected) + ", but the file ends here");
    file_.report.note(position(open_braces_.back()), "this `{` is still open");
    open_braces_.clear();
    return false;
  }
  return fail(token(), "expected " + std::string(expected) + ", not " + shown(token()));
}

std::string Parser::shown(const Token& token) const {
  if (token.kind == TokenKind::end) return "the end of the file";
  constexpr std::size_t longest = 40;
  const std::string_view word = text(token);
  return "`" + std::string(text::first_characters(word, longest)) +
         (word.size() > longest ? "...`" : "`");
}

Position Parser::position(const Token& token) const {
  return {&file_.source, token.offset, std::max<std::size_t>(token.length, 1)};
}

Span Parser::span_from(const Token& first) const {
  const Token& last = tokens_[at_ > 0 ? at_ - 1 : 0];
  const std::uint32_t end = std::max(last.offset + last.length, first.offset + first.length);
  return {first.offset, end - first.offset};
}

void Parser::emit(Operation operation, const Token& token, std::uint32_t operand) {
  syntax_.code.push_back({operation, span(token), operand});
}

Detail& Parser::detail_of(Item& item) {
  item.detail = static_cast<std::uint32_t>(syntax_.details.size());
  return syntax_.details.emplace_back();
}

void parse(ParsedFile& file) {
  if (const auto at = foreign_at(file.source))
    file.report.error({&file.source, *at, 1},
                      "this is no configuration: expected a name, such as `World`");
  else
    Parser(file).parse_file();
}

void parse_override(ParsedFile& file) { Parser(file).parse_override(); }

std::string unquote(std::string_view token) {
  std::string text;
  token.remove_prefix(1);
  if (token.ends_with('"')) token.remove_suffix(1);
  for (std::size_t i = 0; i < token.size(); ++i) {
    if (token[i] == '\\' && i + 1 < token.size()) {
      ++i;
      text += token[i] == 'n' ? '\n' : token[i] == 't' ? '\t' : token[i];
    } else {
      text += token[i];
    }
  }
  return text;
}

}  // namespace hookpoint::language
