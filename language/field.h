// A value as the field that takes it understands it: type, unit, count, range.
#pragma once

#include <optional>

#include "language/expression.h"
#include "language/object.h"
#include "language/schema.h"

namespace hookpoint::language {

struct FieldContext {
  const FieldSchema& schema;
  const Dimension& dimension;        ///< of the schema's unit
  const Dimension& other_dimension;  ///< of its other unit, if it has one
  const ExpressionEvaluator& evaluator;
  Report& report;
};

/// The field with the value of these expressions; nothing after an error. References are left to be
/// resolved. `given` is not set.
std::optional<Field> make_field(const FieldContext& context, Range value);

/// The same of values that are known already, at `position`.
std::optional<Field> make_field(const FieldContext& context, std::vector<Value> values,
                                const Position& position);

/// The shortest text that reads back to the same double.
std::string number_text(double value);
/// The values that a numeric field takes, as a user is told: "greater than 0 kg", "from 0 to 1", ""
/// when any.
std::string range_text(const FieldSchema& field);

}  // namespace hookpoint::language
