// A value as the field that takes it understands it: type, unit, count, range.
#pragma once

#include <optional>

#include "language/schema/schema.h"
#include "language/tree/object.h"
#include "language/values/expression.h"

namespace hookpoint::language {

struct FieldContext {
  const FieldSchema& schema;
  const Dimension& dimension;        ///< of the schema's unit
  const Dimension& other_dimension;  ///< of its other unit, if it has one
  const ExpressionEvaluator& evaluator;
  Report& report;
  const ClassSchema* owner = nullptr;  ///< of the field; null where it stands alone
};

/// The field with the value of these expressions; nothing after an error. References are left to be
/// resolved. `given` is not set.
std::optional<Field> make_field(const FieldContext& context, Range value);

/// The same of values that are known already, at `position`.
std::optional<Field> make_field(const FieldContext& context, std::vector<Value> values,
                                const Position& position);

}  // namespace hookpoint::language
