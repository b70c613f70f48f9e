// A schema made ready for evaluation: each field's dimension and default worked out once, not once
// an object.
#pragma once

#include <deque>
#include <memory>
#include <string>
#include <unordered_map>
#include <vector>

#include "language/schema/schema.h"
#include "language/syntax/syntax.h"
#include "language/tree/field.h"
#include "language/tree/object.h"

namespace hookpoint::language {

struct PreparedClass {
  const ClassSchema* schema = nullptr;
  std::vector<Dimension> dimensions;        ///< one for each field
  std::vector<Dimension> other_dimensions;  ///< one for each field, of its other unit
  std::vector<Field> defaults;              ///< of the fields that have one, in the schema's order
  bool has_required = false;
  bool has_other_units = false;
};

class PreparedSchema {
 public:
  explicit PreparedSchema(const Schema& schema);
  const Schema& schema() const { return schema_; }
  const PreparedClass& of(const ClassSchema& schema) const { return *classes_.at(&schema); }
  /// Of a field of the object's class, in the object.
  const Dimension& dimension(const Object& object, const FieldSchema& field) const;
  /// What a value of a class's field is checked by.
  FieldContext context(const ClassSchema& schema, const FieldSchema& field,
                       const ExpressionEvaluator& evaluator, Report& report) const;
  const std::vector<std::string>& class_names() const { return class_names_; }
  /// See schema_problems().
  const std::vector<std::string>& problems() const { return problems_; }

 private:
  void prepare(const ClassSchema& schema);
  Dimension other_dimension(const ClassSchema& schema, const FieldSchema& field);
  void check_names(const ClassSchema& schema);
  void add_default(const ClassSchema& owner, const FieldSchema& field, PreparedClass& prepared);

  const Schema& schema_;
  std::unordered_map<const ClassSchema*, std::unique_ptr<PreparedClass>> classes_;
  std::deque<SourceFile> default_texts_;
  std::vector<std::string> class_names_, problems_;
};

/// Whether `name` is one of `patterns`, separated by '|', or begins with one; every name does with
/// "".
bool matches_class(std::string_view name, std::string_view patterns);

}  // namespace hookpoint::language
