#include "language/values/expression.h"

#include <algorithm>
#include <cmath>
#include <numbers>

#include "language/names.h"
#include "language/units.h"

namespace hookpoint::language {
namespace {

/// What a value takes of the budget: one, and more for a long text.
std::size_t size_of(const Value& value) {
  constexpr std::size_t bytes_of_a_value = 64;
  return 1 + value.text.size() / bytes_of_a_value;
}

/// What handling so many bytes takes of the budget.
std::size_t steps_of(std::size_t bytes) { return bytes / 8; }

}  // namespace

std::string describe_value(const Value& value) {
  switch (value.kind) {
    case ValueKind::boolean:
      return "true or false";
    case ValueKind::text:
      return "a string";
    case ValueKind::word:
      return "the word `" + value.text + "`";
    default:
      return value.quantity.dimension.dimensionless()
                 ? "a number"
                 : "a number in " + unit_text(value.quantity.dimension);
  }
}

std::optional<Value> ExpressionEvaluator::evaluate(const Expression& expression) const {
  std::vector<Value> stack;
  if (!take(Resource::steps, expression.code.size() + 1, position(expression.span)))
    return std::nullopt;
  bool from_outside = false;
  for (std::uint32_t next = expression.code.begin; next < expression.code.end;) {
    const Instruction& instruction = syntax_.code[next++];
    if (!step(instruction, stack, next)) return std::nullopt;
    if (instruction.operation == Operation::push_trail)
      from_outside = from_outside || stack.back().from_outside;
  }
  stack.back().from_outside = from_outside;
  stack.back().position =
      stack.back().kind == ValueKind::word ? stack.back().position : position(expression.span);
  return std::move(stack.back());
}

std::optional<std::vector<Value>> ExpressionEvaluator::evaluate_list(Range expressions) const {
  std::vector<Value> values;
  bool good = true;
  for (std::uint32_t i = expressions.begin; i < expressions.end; ++i) {
    const Expression& expression = syntax_.expressions[i];
    const Trail* trail = lone_trail(expression);
    const auto variable = trail != nullptr && trail->parts.size() == 1
                              ? variables_.find(text(trail->span))
                              : variables_.end();
    if (variable != variables_.end()) {
      for (const Value& element : variable->second.values) {
        if (!take(Resource::values, size_of(element), position(expression.span)))
          return std::nullopt;
        values.push_back(element);
        if (element.kind != ValueKind::word) values.back().position = position(expression.span);
      }
      good = good && !variable->second.values.empty();
      continue;
    }
    std::optional<Value> value = evaluate(expression);
    good = good && value.has_value();
    if (value && !take(Resource::values, size_of(*value), value->position)) return std::nullopt;
    if (good) values.push_back(std::move(*value));
  }
  return good ? std::optional(std::move(values)) : std::nullopt;
}

std::optional<long> ExpressionEvaluator::evaluate_integer(const Expression& expression,
                                                          std::string_view what) const {
  const std::optional<Value> value = evaluate(expression);
  if (!value || !check_number(*value, position(expression.span))) return std::nullopt;
  const double number = value->quantity.value;
  if (!value->quantity.dimension.dimensionless() || number != std::floor(number) ||
      std::fabs(number) > 1e9) {
    fail(position(expression.span), "expected a whole number for " + std::string(what));
    return std::nullopt;
  }
  return static_cast<long>(number);
}

std::optional<std::string> ExpressionEvaluator::name_text(Span name, bool indexed,
                                                          const Expression& index) const {
  const auto variable = variables_.find(text(name));
  const bool word = variable != variables_.end() && variable->second.stands_for_word;
  std::string result(word ? variable->second.values[0].text : text(name));
  if (!indexed) return result;
  const std::optional<long> number = evaluate_integer(index, "the index");
  if (!number) return std::nullopt;
  if (*number < 0) {
    fail(position(index.span), "an index must not be negative");
    return std::nullopt;
  }
  return result + '[' + std::to_string(*number) + ']';
}

std::optional<std::string> ExpressionEvaluator::trail_text(const Trail& trail) const {
  std::string result;
  const auto first = variables_.find(text(syntax_.parts[trail.parts.begin].name));
  if (first != variables_.end() && first->second.values.empty()) return std::nullopt;
  for (std::uint32_t i = trail.parts.begin; i < trail.parts.end; ++i) {
    const TrailPart& part = syntax_.parts[i];
    if (i == trail.parts.begin && !part.indexed) {
      const auto variable = variables_.find(text(part.name));
      const bool word = variable != variables_.end() && variable->second.values.size() == 1 &&
                        variable->second.values[0].kind == ValueKind::word;
      if (word) {
        result = variable->second.values[0].text;
        continue;
      }
    }
    const std::optional<std::string> name = name_text(part.name, part.indexed, part.index);
    if (!name) return std::nullopt;
    if (!result.empty()) result += '.';
    result += *name;
  }
  if (!take(Resource::steps, steps_of(result.size()), position(trail.span))) return std::nullopt;
  return result;
}

const Trail* ExpressionEvaluator::lone_trail(const Expression& expression) const {
  const Instruction& last = syntax_.code[expression.code.end - 1];
  const bool lone = last.operation == Operation::push_trail &&
                    last.span.offset == expression.span.offset &&
                    last.span.length == expression.span.length;
  return lone ? &syntax_.trails[last.operand] : nullptr;
}

bool ExpressionEvaluator::step(const Instruction& instruction, std::vector<Value>& stack,
                               std::uint32_t& next) const {
  const Position place = position(instruction.span);
  switch (instruction.operation) {
    case Operation::push_number:
      stack.push_back({ValueKind::number, syntax_.quantities[instruction.operand], "", place});
      return true;
    case Operation::push_true:
    case Operation::push_false: {
      const double truth = instruction.operation == Operation::push_true ? 1. : 0.;
      stack.push_back({ValueKind::boolean, {truth, {}}, "", place});
      return true;
    }
    case Operation::push_text:
      if (!take(Resource::steps, steps_of(instruction.span.length), place)) return false;
      stack.push_back({ValueKind::text, {}, unquote(text(instruction.span)), place});
      return true;
    case Operation::push_trail:
      return push_trail(instruction, stack);
    case Operation::call:
      return call(instruction, stack);
    case Operation::apply:
      return apply(static_cast<Operator>(instruction.operand), place, stack);
    case Operation::check_boolean:
      return check_boolean(stack.back(), place);
    case Operation::jump:
      next = instruction.operand;
      return true;
    case Operation::skip_if_false:
    case Operation::skip_if_true: {
      if (!check_boolean(stack.back(), place)) return false;
      const bool truth = stack.back().quantity.value != 0.;
      const bool skip = truth == (instruction.operation == Operation::skip_if_true);
      if (skip) next = instruction.operand;
      if (!skip) stack.pop_back();
      return true;
    }
    case Operation::branch_if_false:
      if (!check_boolean(stack.back(), place)) return false;
      if (stack.back().quantity.value == 0.) next = instruction.operand;
      stack.pop_back();
      return true;
  }
  return false;
}

bool ExpressionEvaluator::push_trail(const Instruction& instruction,
                                     std::vector<Value>& stack) const {
  const Position place = position(instruction.span);
  const Trail& trail = syntax_.trails[instruction.operand];
  const std::string_view name = text(instruction.span);
  const auto variable = variables_.find(name);
  if (trail.parts.size() == 1 && variable != variables_.end()) {
    const std::vector<Value>& values = variable->second.values;
    if (values.empty()) return false;
    if (values.size() != 1) {
      fail(place, "`" + std::string(name) + "` holds " + count_of(values.size(), "value") +
                      ", expected one");
      report_.note(variable->second.position, "`" + std::string(name) + "` is defined here");
      return false;
    }
    stack.push_back(values[0]);
    return take(Resource::steps, steps_of(values[0].text.size()), place);
  }
  if (name == "pi") {
    stack.push_back({ValueKind::number, {std::numbers::pi, {}}, "", place});
    return true;
  }
  std::optional<std::string> word = trail_text(trail);
  if (word) stack.push_back({ValueKind::word, {}, std::move(*word), place});
  return word.has_value();
}

bool ExpressionEvaluator::apply(Operator sign, Position place, std::vector<Value>& stack) const {
  if (sign == Operator::negate) {
    stack.back().quantity.value = -stack.back().quantity.value;
    return check_number(stack.back(), place);
  }
  if (sign == Operator::logical_not) {
    stack.back().quantity.value = 1. - stack.back().quantity.value;
    return check_boolean(stack.back(), place);
  }
  const Value right = std::move(stack.back());
  stack.pop_back();
  Value& left = stack.back();
  if (sign >= Operator::less) return compare(sign, place, left, right);
  const bool text = left.kind == ValueKind::text || right.kind == ValueKind::text;
  if (text && sign == Operator::add) return join_texts(left, right, place);
  if (!check_number(left, place) || !check_number(right, place)) return false;
  return arithmetic(sign, place, left, right);
}

bool ExpressionEvaluator::join_texts(Value& left, const Value& right, Position place) const {
  constexpr std::size_t most_bytes = 4096;
  for (const Value* value : {static_cast<const Value*>(&left), &right}) {
    if (value->kind != ValueKind::text && value->kind != ValueKind::word)
      return fail(place, "a string and " + describe_value(*value) + " cannot be put together");
  }
  if (left.text.size() + right.text.size() > most_bytes)
    return fail(place, "the string would be longer than " + std::to_string(most_bytes) + " bytes");
  left = {ValueKind::text, {}, left.text + right.text, place};
  return take(Resource::steps, steps_of(left.text.size()), place);
}

bool ExpressionEvaluator::arithmetic(Operator sign, Position place, Value& left,
                                     const Value& right) const {
  const Quantity &a = left.quantity, &b = right.quantity;
  const Dimension& sum = a.dimension.angle != 0 ? a.dimension : b.dimension;
  switch (sign) {
    case Operator::add:
      return check_comparable(left, right, place, "added") &&
             finish(left, a.value + b.value, sum, place);
    case Operator::subtract:
      return check_comparable(left, right, place, "subtracted") &&
             finish(left, a.value - b.value, sum, place);
    case Operator::multiply:
      return finish(left, a.value * b.value, a.dimension * b.dimension, place);
    case Operator::divide:
      if (b.value == 0.) return fail(place, "division by zero");
      return finish(left, a.value / b.value, a.dimension / b.dimension, place);
    default: {
      const FunctionResult result = raise_quantity(a, b);
      if (!result.error.empty()) return fail(place, result.error);
      return finish(left, result.quantity.value, result.quantity.dimension, place);
    }
  }
}

bool ExpressionEvaluator::compare(Operator sign, Position place, Value& left,
                                  const Value& right) const {
  const bool equality = sign == Operator::equal || sign == Operator::not_equal;
  const bool words = left.kind == right.kind && left.kind != ValueKind::number;
  bool result = false;
  if (equality && words) {
    const bool same = left.text == right.text && left.quantity.value == right.quantity.value;
    result = same == (sign == Operator::equal);
  } else {
    if (!check_number(left, place) || !check_number(right, place)) return false;
    if (!check_comparable(left, right, place, "compared")) return false;
    const double a = left.quantity.value, b = right.quantity.value;
    switch (sign) {
      case Operator::less:
        result = a < b;
        break;
      case Operator::less_equal:
        result = a <= b;
        break;
      case Operator::greater:
        result = a > b;
        break;
      case Operator::greater_equal:
        result = a >= b;
        break;
      default:
        result = (a == b) == (sign == Operator::equal);
    }
  }
  left = {ValueKind::boolean, {result ? 1. : 0., {}}, "", place};
  return true;
}

bool ExpressionEvaluator::call(const Instruction& instruction, std::vector<Value>& stack) const {
  const Position place = position(instruction.span);
  const std::string name(text(instruction.span));
  std::vector<Quantity> arguments;
  for (std::size_t i = stack.size() - instruction.operand; i < stack.size(); ++i) {
    if (!check_number(stack[i], place)) return false;
    arguments.push_back(stack[i].quantity);
  }
  stack.resize(stack.size() - instruction.operand);
  const std::optional<FunctionResult> result = call_function(name, arguments);
  if (!result)
    return fail(place, "unknown function `" + name + "`" + did_you_mean(name, function_names()));
  if (!result->error.empty()) return fail(place, result->error);
  Value& value = stack.emplace_back();
  return finish(value, result->quantity.value, result->quantity.dimension, place);
}

bool ExpressionEvaluator::check_number(const Value& value, Position place) const {
  if (value.kind == ValueKind::number) return true;
  if (value.kind == ValueKind::word) return unknown_word(value);
  return fail(place, "expected a number, not " + describe_value(value));
}

bool ExpressionEvaluator::check_boolean(const Value& value, Position place) const {
  if (value.kind == ValueKind::boolean) return true;
  if (value.kind == ValueKind::word) return unknown_word(value);
  return fail(place, "expected true or false, not " + describe_value(value));
}

bool ExpressionEvaluator::check_comparable(const Value& left, const Value& right, Position place,
                                           std::string_view action) const {
  const Dimension &a = left.quantity.dimension, &b = right.quantity.dimension;
  if (comparable(a, b)) return true;
  return fail(place, describe_dimension(a) + " and " + describe_dimension(b) + " cannot be " +
                         std::string(action));
}

bool ExpressionEvaluator::finish(Value& value, double result, Dimension dimension,
                                 Position place) const {
  if (!std::isfinite(result)) return fail(place, "the result does not fit a double (about 1e308)");
  constexpr int largest_exponent = 100;
  for (const int exponent : {dimension.mass, dimension.length, dimension.time, dimension.angle}) {
    if (std::abs(exponent) > largest_exponent)
      return fail(place, "the result's unit has no meaning");
  }
  value = {ValueKind::number, {result, dimension}, "", place};
  return true;
}

bool ExpressionEvaluator::fail(Position place, std::string message) const {
  report_.error(place, std::move(message));
  return false;
}

bool ExpressionEvaluator::unknown_word(const Value& value) const {
  if (file_.report.has_errors() || report_.told_at(value.position)) return false;
  if (value.text.find('.') != std::string::npos) {
    return fail(value.position, "`" + value.text + "` is a reference; a number is expected here");
  }
  std::vector<std::string> names = function_names();
  names.emplace_back("pi");
  for (const auto& [name, variable] : variables_) names.emplace_back(name);
  std::sort(names.begin(), names.end());
  fail(value.position, "undefined variable `" + value.text + "`" + did_you_mean(value.text, names));
  if (find_unit(value.text) != nullptr) {
    report_.note(value.position, "`" + value.text +
                                     "` is a unit: a unit stands right after a number, as in `1 " +
                                     value.text + "`");
  }
  return false;
}

}  // namespace hookpoint::language
