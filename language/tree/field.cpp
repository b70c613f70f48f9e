#include "language/tree/field.h"

#include <algorithm>
#include <charconv>
#include <cmath>

#include "language/names.h"
#include "language/schema/absent.h"
#include "language/schema/describe.h"
#include "language/units.h"
#include "language/values/formula.h"
#include "language/wording.h"
#include "math/orientation.h"
#include "text/display.h"

namespace hookpoint::language {
namespace {

std::string quoted(const std::string& name) { return "`" + name + "`"; }

bool is_word(const Value& value) {
  return value.kind == ValueKind::word || value.kind == ValueKind::text;
}

std::string other_unit_text(const OtherUnit& other) {
  return " (in " + other.unit + " where " + quoted(other.field) + " is " + other.word + ")";
}

class FieldMaker {
 public:
  FieldMaker(const FieldContext& context, Range value)
      : schema_(context.schema), context_(context), value_(value), report_(context.report) {
    const std::vector<Expression>& expressions = context.evaluator.syntax().expressions;
    const Span first = expressions[value.begin].span, last = expressions[value.end - 1].span;
    field_.position =
        context.evaluator.position({first.offset, last.offset + last.length - first.offset});
  }
  FieldMaker(const FieldContext& context, std::vector<Value> values, const Position& position)
      : schema_(context.schema),
        context_(context),
        report_(context.report),
        values_(std::move(values)) {
    field_.position = position;
  }

  std::optional<Field> run();

 private:
  /// A number's word in its place, such as `auto`.
  bool stands_for_number(std::string_view word);
  /// Words and strings in the place of numbers.
  bool make_words_for_numbers();
  bool make_numbers();
  bool make_orientation();
  bool make_boolean();
  bool make_text();
  bool make_choice();
  bool make_words();
  bool make_reference();
  bool make_formula();
  bool check_number(const Value& value);
  bool check_range(const Value& value);
  static bool is_whole(double number);
  bool in_range(double number) const;
  /// A number that the field does not take, with as many digits as show that.
  std::string shown(double number) const;
  bool check_text(const Value& value);
  bool check_count(std::size_t count, int least, int most, std::string_view noun);
  /// The values of the list; nothing after an error.
  bool evaluate();
  /// Field::unit.
  std::string written_unit() const;
  /// The trail that is all of the one expression, else null: no variable's value.
  const Trail* lone_trail() const;
  /// The word that is all of the one expression, else "".
  std::string_view bare_word() const;
  std::string choices_text() const { return "expected one of " + join(schema_.choices, ", "); }
  /// What to do instead of a word of this field; "" if there is nothing to say.
  std::string instead_of(std::string_view word) const {
    if (context_.owner == nullptr) return "";
    return std::string(language::instead_of(context_.owner->name + '.' + schema_.name, word));
  }
  bool fail(const Position& place, std::string message) {
    report_.error(place, std::move(message));
    return false;
  }

  const FieldSchema& schema_;
  const FieldContext& context_;
  Range value_;  ///< empty where the values are known already
  Report& report_;
  std::vector<Value> values_;
  Field field_;
};

std::optional<Field> FieldMaker::run() {
  field_.schema = &schema_;
  bool good = false;
  switch (schema_.type) {
    case FieldType::number:
    case FieldType::integer:
    case FieldType::numbers:
      good = make_numbers();
      break;
    case FieldType::orientation:
      good = make_orientation();
      break;
    case FieldType::boolean:
      good = make_boolean();
      break;
    case FieldType::text:
      good = make_text();
      break;
    case FieldType::choice:
      good = make_choice();
      break;
    case FieldType::words:
      good = make_words();
      break;
    case FieldType::object:
    case FieldType::port:
      good = make_reference();
      break;
    case FieldType::formula:
      good = make_formula();
      break;
  }
  field_.from_outside = std::ranges::any_of(values_, &Value::from_outside);
  return good ? std::optional(std::move(field_)) : std::nullopt;
}

bool FieldMaker::evaluate() {
  if (value_.empty()) return true;
  std::optional<std::vector<Value>> values = context_.evaluator.evaluate_list(value_);
  if (values) values_ = std::move(*values);
  return values.has_value();
}

std::string FieldMaker::written_unit() const {
  const Syntax& syntax = context_.evaluator.syntax();
  for (std::uint32_t i = value_.begin; i < value_.end; ++i) {
    const Range code = syntax.expressions[i].code;
    for (std::uint32_t at = code.begin; at < code.end; ++at) {
      const Instruction& instruction = syntax.code[at];
      if (instruction.operation != Operation::push_number) continue;
      if (syntax.quantities[instruction.operand].dimension != field_.dimension) continue;
      return std::string(context_.evaluator.text(syntax.units[instruction.operand]));
    }
  }
  return "";
}

const Trail* FieldMaker::lone_trail() const {
  if (value_.size() != 1) return nullptr;
  return context_.evaluator.lone_trail(context_.evaluator.syntax().expressions[value_.begin]);
}

std::string_view FieldMaker::bare_word() const {
  const Trail* trail = lone_trail();
  return trail != nullptr && trail->parts.size() == 1 ? context_.evaluator.text(trail->span) : "";
}

bool FieldMaker::check_count(std::size_t count, int least, int most, std::string_view noun) {
  if (count >= static_cast<std::size_t>(least) && count <= static_cast<std::size_t>(most))
    return true;
  std::string wanted = count_of(static_cast<std::size_t>(most), noun);
  if (least != most) wanted = std::to_string(least) + " to " + wanted;
  if (most > 1000) wanted = "at least " + count_of(static_cast<std::size_t>(least), noun);
  const std::string instead = count > static_cast<std::size_t>(most) ? instead_of("...") : "";
  return fail(field_.position, quoted(schema_.name) + " takes " + wanted + ", not " +
                                   std::to_string(count) + (instead.empty() ? "" : ": " + instead));
}

bool FieldMaker::check_number(const Value& value) {
  if (value.kind == ValueKind::word) return context_.evaluator.unknown_word(value);
  if (value.kind != ValueKind::number) {
    return fail(value.position,
                quoted(schema_.name) + " takes a number, not " + describe_value(value));
  }
  const bool fits_other =
      schema_.other_unit && fits(value.quantity.dimension, context_.other_dimension);
  if (schema_.unit != "?" && !fits(value.quantity.dimension, context_.dimension) && !fits_other) {
    std::string wanted =
        schema_.unit.empty() ? "a number without a unit" : "a value in " + schema_.unit;
    if (schema_.other_unit) wanted += other_unit_text(*schema_.other_unit);
    return fail(value.position, quoted(schema_.name) + " takes " + wanted + ", not in " +
                                    unit_text(value.quantity.dimension));
  }
  return check_range(value);
}

bool FieldMaker::is_whole(double number) {
  constexpr double largest_whole = 9007199254740992.;
  return number == std::floor(number) && std::fabs(number) <= largest_whole;
}

bool FieldMaker::in_range(double number) const {
  const bool below =
      schema_.exclusive_minimum ? number <= schema_.minimum : number < schema_.minimum;
  const bool above =
      schema_.exclusive_maximum ? number >= schema_.maximum : number > schema_.maximum;
  return !below && !above;
}

std::string FieldMaker::shown(double number) const {
  std::string text = rounded_text(number);
  double read = number;
  std::from_chars(text.data(), text.data() + text.size(), read);
  const bool seems_right = in_range(read) && (schema_.type != FieldType::integer || is_whole(read));
  return seems_right ? number_text(number) : text;
}

bool FieldMaker::check_range(const Value& value) {
  const double number = value.quantity.value;
  if (schema_.type == FieldType::integer && !is_whole(number)) {
    return fail(value.position,
                quoted(schema_.name) + " takes a whole number, not " + shown(number));
  }
  if (in_range(number)) return true;
  return fail(value.position, quoted(schema_.name) + " must be " + range_text(schema_) + ", not " +
                                  shown(number) + unit_after(schema_));
}

bool FieldMaker::stands_for_number(std::string_view word) {
  if (std::ranges::find(schema_.choices, word) == schema_.choices.end()) return false;
  field_.words.emplace_back(word);
  return true;
}

/// A text is shown on terminals, in figures and in pages, and names files: none of them may take it
/// for a command.
bool FieldMaker::check_text(const Value& value) {
  if (text::find_control(value.text) == std::string::npos) return true;
  return fail(value.position, quoted(schema_.name) +
                                  " takes characters that can be seen, on one line: no line end, "
                                  "tab or other control character");
}

bool FieldMaker::make_numbers() {
  if (stands_for_number(bare_word())) return true;
  if (!evaluate()) return false;
  if (values_.size() == 1 && values_[0].kind == ValueKind::word &&
      stands_for_number(values_[0].text))
    return true;
  if (schema_.or_words && !values_.empty() && is_word(values_[0])) return make_words_for_numbers();
  const bool list = schema_.type == FieldType::numbers;
  if (!check_count(values_.size(), list ? schema_.min_count : 1, list ? schema_.max_count : 1,
                   "number"))
    return false;
  if (schema_.unit == "?" || schema_.other_unit) field_.dimension = values_[0].quantity.dimension;
  for (const Value& value : values_) {
    if (!check_number(value)) return false;
    if (schema_.unit == "?" && !fits(value.quantity.dimension, field_.dimension)) {
      return fail(value.position, "the values of " + quoted(schema_.name) +
                                      " must have one unit, not " +
                                      describe_dimension(field_.dimension) + " and " +
                                      describe_dimension(value.quantity.dimension));
    }
    field_.numbers.push_back(value.quantity.value);
  }
  if (schema_.unit == "?") field_.unit = written_unit();
  return true;
}

bool FieldMaker::make_words_for_numbers() {
  const bool list = schema_.type == FieldType::numbers;
  if (!check_count(values_.size(), list ? schema_.min_count : 1, list ? schema_.max_count : 1,
                   "word"))
    return false;
  for (const Value& value : values_) {
    if (!is_word(value)) {
      return fail(value.position,
                  "the values of " + quoted(schema_.name) + " are all numbers or all words, not " +
                      describe_value(value) + " behind " + describe_value(values_[0]));
    }
    if (!check_text(value)) return false;
    field_.words.push_back(value.text);
    field_.quoted.push_back(value.kind == ValueKind::text);
    field_.places.push_back(value.position);
  }
  return true;
}

bool FieldMaker::make_orientation() {
  constexpr Dimension angle{0, 0, 0, 1};
  if (!evaluate()) return false;
  if (values_.size() != 3 && values_.size() != 4) {
    return fail(field_.position,
                quoted(schema_.name) +
                    " takes a quaternion w, x, y, z or three angles roll, pitch, yaw, not " +
                    count_of(values_.size(), "number"));
  }
  for (const Value& value : values_) {
    if (value.kind == ValueKind::word) return context_.evaluator.unknown_word(value);
    const Dimension& dimension = value.quantity.dimension;
    if (value.kind != ValueKind::number ||
        !fits(dimension, values_.size() == 3 ? angle : Dimension{})) {
      const std::string wanted = values_.size() == 3 ? "angles" : "numbers without a unit";
      return fail(value.position, quoted(schema_.name) + " takes " + wanted + " here, not " +
                                      describe_value(value));
    }
    field_.numbers.push_back(value.quantity.value);
  }
  const std::optional<std::array<double, 4>> unit = orientation_of(field_.numbers);
  if (!unit)
    return fail(field_.position, quoted(schema_.name) + " must not be the zero quaternion");
  field_.numbers.assign(unit->begin(), unit->end());
  return true;
}

bool FieldMaker::make_boolean() {
  if (!evaluate() || !check_count(values_.size(), 1, 1, "value")) return false;
  const Value& value = values_[0];
  if (value.kind == ValueKind::word) {
    const std::string hint = did_you_mean(value.text, {"true", "false"});
    return fail(value.position,
                quoted(schema_.name) + " takes true or false, not " + quoted(value.text) + hint);
  }
  if (value.kind != ValueKind::boolean) {
    return fail(value.position,
                quoted(schema_.name) + " takes true or false, not " + describe_value(value));
  }
  field_.numbers.push_back(value.quantity.value);
  return true;
}

bool FieldMaker::make_text() {
  if (!evaluate() || !check_count(values_.size(), 1, 1, "string")) return false;
  const Value& value = values_[0];
  if (value.kind != ValueKind::text) {
    return fail(value.position,
                quoted(schema_.name) + " takes a string in quotes, not " + describe_value(value));
  }
  if (!check_text(value)) return false;
  field_.words.push_back(value.text);
  return true;
}

bool FieldMaker::make_choice() {
  const std::string_view word = bare_word();
  if (std::ranges::find(schema_.choices, word) != schema_.choices.end()) {
    field_.words.emplace_back(word);
    return true;
  }
  if (!evaluate() || !check_count(values_.size(), 1, 1, "word")) return false;
  const Value& value = values_[0];
  if (value.kind == ValueKind::text) {
    return fail(value.position,
                quoted(schema_.name) + " takes a word without quotes: " + choices_text());
  }
  if (value.kind != ValueKind::word) {
    return fail(value.position, quoted(schema_.name) + " takes a word, not " +
                                    describe_value(value) + ": " + choices_text());
  }
  if (std::ranges::find(schema_.choices, value.text) == schema_.choices.end()) {
    const std::string instead = instead_of(value.text);
    return fail(value.position,
                quoted(value.text) + " is no value of " + quoted(schema_.name) + ": " +
                    choices_text() +
                    (instead.empty() ? did_you_mean(value.text, schema_.choices) : "; " + instead));
  }
  field_.words.push_back(value.text);
  return true;
}

bool FieldMaker::make_words() {
  if (!evaluate() || !check_count(values_.size(), schema_.min_count, schema_.max_count, "word"))
    return false;
  for (const Value& value : values_) {
    if (!is_word(value)) {
      return fail(value.position,
                  quoted(schema_.name) + " takes words or strings, not " + describe_value(value));
    }
    if (!check_text(value)) return false;
    field_.words.push_back(value.text);
    field_.places.push_back(value.position);
  }
  return true;
}

bool FieldMaker::make_reference() {
  const std::string wanted =
      schema_.type == FieldType::port ? "the trail of a port" : "the name of an object";
  if (value_.size() == 1 || values_.size() == 1) {
    const Trail* trail = lone_trail();
    std::optional<std::string> text;
    if (trail != nullptr) {
      text = context_.evaluator.trail_text(*trail);
      if (!text) return false;
    } else {
      if (!evaluate()) return false;
      if (values_[0].kind == ValueKind::word) text = values_[0].text;
    }
    if (text) {
      field_.reference.trail = *text;
      field_.reference.position = field_.position;
      return true;
    }
  }
  return fail(field_.position, quoted(schema_.name) + " takes " + wanted);
}

bool FieldMaker::make_formula() {
  if (value_.size() != 1)
    return fail(field_.position, quoted(schema_.name) + " takes one expression");
  const Expression& expression = context_.evaluator.syntax().expressions[value_.begin];
  std::optional<Formula> formula = make_formula_of(context_.evaluator, expression, report_);
  if (!formula) return false;
  field_.formula = std::make_shared<const Formula>(std::move(*formula));
  return true;
}

}  // namespace

std::optional<Field> make_field(const FieldContext& context, Range value) {
  return FieldMaker(context, value).run();
}

std::optional<Field> make_field(const FieldContext& context, std::vector<Value> values,
                                const Position& position) {
  return FieldMaker(context, std::move(values), position).run();
}

}  // namespace hookpoint::language
