// Values, expressions and references, as postfix code.
#include <algorithm>
#include <charconv>
#include <cmath>

#include "language/names.h"
#include "language/syntax/parser.h"
#include "language/units.h"

namespace hookpoint::language {

bool Parser::parse_value(Range& value) {
  value.begin = static_cast<std::uint32_t>(syntax_.expressions.size());
  do {
    Expression expression;
    if (!parse_expression(expression)) return false;
    syntax_.expressions.push_back(expression);
    // In an Include's arguments the comma may end the value: `a = 1, b = 2`.
    const bool next_argument =
        at(TokenKind::comma) && at(TokenKind::identifier, 1) && at(TokenKind::assign, 2);
    if (next_argument) break;
  } while (accept(TokenKind::comma));
  value.end = static_cast<std::uint32_t>(syntax_.expressions.size());
  return true;
}

bool Parser::parse_expression(Expression& expression) {
  const Token first = token();
  const auto begin = static_cast<std::uint32_t>(syntax_.code.size());
  if (!parse_conditional()) return false;
  expression = {{begin, static_cast<std::uint32_t>(syntax_.code.size())}, span_from(first)};
  return true;
}

bool Parser::parse_conditional() {
  const Level level(*this);
  if (!level || !parse_or()) return false;
  if (at(TokenKind::question)) {
    const Token question = token();
    ++at_;
    const std::size_t branch = syntax_.code.size();
    emit(Operation::branch_if_false, question);
    if (!parse_conditional() || !expect(TokenKind::colon, "`:`")) return false;
    const std::size_t jump = syntax_.code.size();
    emit(Operation::jump, question);
    syntax_.code[branch].operand = static_cast<std::uint32_t>(syntax_.code.size());
    if (!parse_conditional()) return false;
    syntax_.code[jump].operand = static_cast<std::uint32_t>(syntax_.code.size());
  }
  return true;
}

bool Parser::parse_or() {
  if (!parse_and()) return false;
  while (at(TokenKind::or_operator)) {
    const Token operation = token();
    ++at_;
    const std::size_t skip = syntax_.code.size();
    emit(Operation::skip_if_true, operation);
    if (!parse_and()) return false;
    emit(Operation::check_boolean, operation);
    syntax_.code[skip].operand = static_cast<std::uint32_t>(syntax_.code.size());
  }
  return true;
}

bool Parser::parse_and() {
  if (!parse_comparison()) return false;
  while (at(TokenKind::and_operator)) {
    const Token operation = token();
    ++at_;
    const std::size_t skip = syntax_.code.size();
    emit(Operation::skip_if_false, operation);
    if (!parse_comparison()) return false;
    emit(Operation::check_boolean, operation);
    syntax_.code[skip].operand = static_cast<std::uint32_t>(syntax_.code.size());
  }
  return true;
}

bool Parser::parse_comparison() {
  const auto at_comparison = [&] {
    return token().kind >= TokenKind::less && token().kind <= TokenKind::not_equal;
  };
  if (!parse_sum()) return false;
  if (!at_comparison()) return true;
  const Token operation = token();
  ++at_;
  if (!parse_sum()) return false;
  if (at_comparison())
    return fail(token(), "comparisons do not chain: write `a < b && b < c`, or parentheses");
  const auto index = static_cast<int>(operation.kind) - static_cast<int>(TokenKind::less);
  apply(static_cast<Operator>(static_cast<int>(Operator::less) + index), operation);
  return true;
}

bool Parser::parse_sum() {
  if (!parse_product()) return false;
  while (at(TokenKind::plus) || at(TokenKind::minus)) {
    const Token operation = token();
    ++at_;
    if (!parse_product()) return false;
    apply(operation.kind == TokenKind::plus ? Operator::add : Operator::subtract, operation);
  }
  return true;
}

bool Parser::parse_product() {
  if (!parse_unary()) return false;
  while (at(TokenKind::star) || at(TokenKind::slash)) {
    const Token operation = token();
    ++at_;
    if (!parse_unary()) return false;
    apply(operation.kind == TokenKind::star ? Operator::multiply : Operator::divide, operation);
  }
  return true;
}

bool Parser::parse_unary() {
  const std::size_t first = at_;
  while (at(TokenKind::minus) || at(TokenKind::plus) || at(TokenKind::not_operator)) ++at_;
  const std::size_t last = at_;
  if (!parse_power()) return false;
  for (std::size_t i = last; i > first; --i) {
    const Token& operation = tokens_[i - 1];
    if (operation.kind == TokenKind::minus) apply(Operator::negate, operation);
    if (operation.kind == TokenKind::not_operator) apply(Operator::logical_not, operation);
  }
  return true;
}

bool Parser::parse_power() {
  if (!parse_primary()) return false;
  if (!at(TokenKind::caret)) return true;
  const Token operation = token();
  ++at_;
  const Level level(*this);
  if (!level || !parse_unary()) return false;
  apply(Operator::raise, operation);
  return true;
}

bool Parser::parse_primary() {
  const Token first = token();
  if (at(TokenKind::number)) return parse_number();
  if (at(TokenKind::text)) {
    ++at_;
    emit(Operation::push_text, first);
    return true;
  }
  if (at(TokenKind::open_parenthesis)) {
    ++at_;
    return parse_conditional() && expect(TokenKind::close_parenthesis, "`)`");
  }
  if (!at(TokenKind::identifier)) return fail_here("a value");
  if (at(TokenKind::open_parenthesis, 1)) return parse_call();
  if (!at(TokenKind::dot, 1) && !at(TokenKind::open_bracket, 1) &&
      (at_word("true") || at_word("false"))) {
    emit(at_word("true") ? Operation::push_true : Operation::push_false, first);
    ++at_;
    return true;
  }
  return parse_trail_value();
}

bool Parser::parse_trail_value() {
  Trail trail;
  if (!parse_trail(trail)) return false;
  syntax_.code.push_back(
      {Operation::push_trail, trail.span, static_cast<std::uint32_t>(syntax_.trails.size())});
  syntax_.trails.push_back(trail);
  return true;
}

bool Parser::parse_call() {
  const Token name = token();
  at_ += 2;
  std::uint32_t count = 0;
  while (!at(TokenKind::close_parenthesis)) {
    if (!parse_conditional()) return false;
    ++count;
    if (!accept(TokenKind::comma) && !at(TokenKind::close_parenthesis))
      return fail_here("`,` or `)`");
  }
  ++at_;
  emit(Operation::call, name, count);
  return true;
}

bool Parser::parse_number() {
  const Token number = token();
  const std::string_view word = text(number);
  const std::size_t digits = digits_length(word);
  double value = 0.;
  const std::errc error = std::from_chars(word.data(), word.data() + digits, value).ec;
  if (error == std::errc::result_out_of_range) {
    return fail(number,
                "the number " + shown(number) + " does not fit a double (about 1e-308 to 1e308)");
  }
  const std::size_t unit_at = std::min(word.find_first_not_of(" \t", digits), word.size());
  const Span written{number.offset + static_cast<std::uint32_t>(unit_at),
                     number.length - static_cast<std::uint32_t>(unit_at)};
  const Unit unit = written.length == 0 ? Unit{} : scan_unit(word.substr(unit_at))->unit;
  Quantity quantity{value * unit.numerator / unit.denominator, unit.dimension};
  if (!std::isfinite(quantity.value))
    return fail(number, "the number " + shown(number) + " does not fit a double in SI units");
  ++at_;
  emit(Operation::push_number, number, static_cast<std::uint32_t>(syntax_.quantities.size()));
  syntax_.quantities.push_back(quantity);
  syntax_.units.push_back(written);
  const bool word_follows = at(TokenKind::identifier) && !token().begins_line && !at_keyword();
  if (word_follows && !at(TokenKind::assign, 1) && !at(TokenKind::open_brace, 1)) {
    const std::string name(text(token()));
    if (find_unit(name) != nullptr) return fail_unit(number, written.length > 0);
    const std::string hint = did_you_mean(name, unit_names());
    return fail(token(),
                "unknown unit `" + name + "`" +
                    (hint.empty() ? "; known units are " + join(unit_names(), " ") : hint));
  }
  return true;
}

bool Parser::fail_unit(const Token& number, bool has_unit) {
  const std::string name(text(token())), before(text(number));
  if (has_unit)
    return fail(token(), "`" + name +
                             "` is a second unit: units are joined by `.` or `/`, as in `" +
                             before + "." + name + "`");
  return fail(token(), "the unit `" + name + "` stands right behind its number: `" + before + " " +
                           name + "`");
}

bool Parser::parse_trail(Trail& trail) {
  const Token first = token();
  std::vector<TrailPart> parts;
  do {
    if (!at(TokenKind::identifier)) return fail_here("a name");
    TrailPart& part = parts.emplace_back();
    part.name = span(token());
    ++at_;
    part.indexed = at(TokenKind::open_bracket);
    if (part.indexed && !parse_index(part.index)) return false;
  } while (accept(TokenKind::dot));
  trail.parts.begin = static_cast<std::uint32_t>(syntax_.parts.size());
  syntax_.parts.insert(syntax_.parts.end(), parts.begin(), parts.end());
  trail.parts.end = static_cast<std::uint32_t>(syntax_.parts.size());
  trail.span = span_from(first);
  return true;
}

bool Parser::parse_index(Expression& index) {
  const Token bracket = token();
  ++at_;
  // The index is evaluated with the name that it belongs to: the expression around it jumps over
  // its code.
  const std::size_t jump = syntax_.code.size();
  emit(Operation::jump, bracket);
  if (!parse_expression(index)) return false;
  syntax_.code[jump].operand = static_cast<std::uint32_t>(syntax_.code.size());
  return expect(TokenKind::close_bracket, "`]`");
}

}  // namespace hookpoint::language
