// Expressions: postfix code to values, with dimensions and every error at its place.
#pragma once

#include <optional>
#include <span>
#include <string>
#include <string_view>
#include <unordered_map>
#include <vector>

#include "language/report.h"
#include "language/values/budget.h"
#include "language/values/value.h"

namespace hookpoint::language {

/// A Let, a Param or a loop's variable: a value, or a list of them; empty when its value was wrong,
/// and said to be.
struct Variable {
  std::vector<Value> values;
  Position position;  ///< of its definition
  /// A loop's over words: wherever its name stands as an object's or in a trail, the word is meant.
  bool stands_for_word = false;
};

/// The variables of one file, by names that lie in its text. A name is defined once wherever it can
/// be seen: nothing is shadowed.
using Variables = std::unordered_map<std::string_view, Variable>;

class ExpressionEvaluator {
 public:
  /// Cheap to make: it holds references only.
  ExpressionEvaluator(const ParsedFile& file, const Variables& variables, Report& report,
                      Budget& budget)
      : file_(file),
        syntax_(file.syntax),
        variables_(variables),
        report_(report),
        budget_(budget) {}

  /// The value; nothing after an error.
  std::optional<Value> evaluate(const Expression& expression) const;
  /// The values of a list; a variable that holds a list stands for all of it.
  std::optional<std::vector<Value>> evaluate_list(Range expressions) const;
  /// A whole number, as an index or a loop's end is; nothing after an error.
  std::optional<long> evaluate_integer(const Expression& expression, std::string_view what) const;
  /// The trail's text, indices evaluated: "leg[2].femur". A first name that is a variable holding a
  /// word stands for the word.
  std::optional<std::string> trail_text(const Trail& trail) const;
  /// `name` or `name[index]`; the word in place of the name of a loop's variable that stands for
  /// one.
  std::optional<std::string> name_text(Span name, bool indexed, const Expression& index) const;
  /// The trail, if the expression is nothing else; else null.
  const Trail* lone_trail(const Expression& expression) const;

  /// The variable of that name, or null.
  const Variable* variable(std::string_view name) const {
    const auto found = variables_.find(name);
    return found == variables_.end() ? nullptr : &found->second;
  }

  /// The error that a word is no variable; false. In a file with syntax errors the variable may
  /// have been lost to one: no error then.
  bool unknown_word(const Value& value) const;

  const Syntax& syntax() const { return syntax_; }
  std::string_view text(Span span) const {
    return std::string_view(file_.source.text).substr(span.offset, span.length);
  }
  Position position(Span span) const { return {&file_.source, span.offset, span.length}; }

 private:
  bool step(const Instruction& instruction, std::vector<Value>& stack, std::uint32_t& next) const;
  bool push_trail(const Instruction& instruction, std::vector<Value>& stack) const;
  bool apply(Operator sign, Position place, std::vector<Value>& stack) const;
  /// Strings, and words behind or before one, put together.
  bool join_texts(Value& left, const Value& right, Position place) const;
  bool arithmetic(Operator sign, Position place, Value& left, const Value& right) const;
  bool compare(Operator sign, Position place, Value& left, const Value& right) const;
  bool call(const Instruction& instruction, std::vector<Value>& stack) const;
  bool check_number(const Value& value, Position place) const;
  bool check_boolean(const Value& value, Position place) const;
  bool check_comparable(const Value& left, const Value& right, Position place,
                        std::string_view action) const;
  bool finish(Value& value, double result, Dimension dimension, Position place) const;
  bool fail(Position place, std::string message) const;
  bool take(Resource resource, std::size_t amount, Position place) const {
    return budget_.take(resource, amount, place, report_);
  }

  const ParsedFile& file_;
  const Syntax& syntax_;
  const Variables& variables_;
  Report& report_;
  Budget& budget_;
};

/// A function's result, or a message that says what is wrong with the arguments.
struct FunctionResult {
  Quantity quantity;
  std::string error;
};
/// `name` applied to `arguments` (functions.cpp). Nothing when there is no such function.
std::optional<FunctionResult> call_function(std::string_view name,
                                            std::span<const Quantity> arguments);
/// The same of the arguments' units alone, whatever their values (but for an exponent's): the
/// result is 0 in its unit.
std::optional<FunctionResult> unit_of_call(std::string_view name,
                                           std::span<const Quantity> arguments);
/// What computes the function of that name, which there is, from numbers in SI: NaN or infinite
/// where it has no value. Allocates nothing.
using NumberFunction = double (*)(std::span<const double>);
NumberFunction number_function(std::string_view name);
const std::vector<std::string>& function_names();
/// base ^ exponent: a value with a unit to whole powers only.
FunctionResult raise_quantity(const Quantity& base, const Quantity& exponent);

}  // namespace hookpoint::language
