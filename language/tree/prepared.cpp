#include "language/tree/prepared.h"

#include <algorithm>
#include <sstream>

#include "language/tree/number_of.h"
#include "language/units.h"

namespace hookpoint::language {

bool matches_class(std::string_view name, std::string_view patterns) {
  while (true) {
    const std::size_t end = patterns.find('|');
    if (name.starts_with(patterns.substr(0, end))) return true;
    if (end == std::string_view::npos) return false;
    patterns.remove_prefix(end + 1);
  }
}

PreparedSchema::PreparedSchema(const Schema& schema) : schema_(schema) {
  for (const auto& [name, class_schema] : schema.classes()) {
    prepare(class_schema);
    check_names(class_schema);
    if (name != "Wire" && name != "Group" && class_schema.only_in.empty())
      class_names_.push_back(name);
  }
}

void PreparedSchema::prepare(const ClassSchema& schema) {
  auto prepared = std::make_unique<PreparedClass>();
  prepared->schema = &schema;
  for (const FieldSchema& field : schema.fields) {
    const std::optional<Unit> unit = parse_unit(field.unit == "?" ? "" : field.unit);
    if (!unit || unit->numerator != unit->denominator) {
      problems_.push_back(schema.name + "." + field.name + ": `" + field.unit +
                          "` is not an SI unit of the language");
    }
    prepared->dimensions.push_back(unit ? unit->dimension : Dimension{});
    prepared->other_dimensions.push_back(other_dimension(schema, field));
    prepared->has_required = prepared->has_required || field.required;
    prepared->has_other_units = prepared->has_other_units || field.other_unit;
    if (!field.default_text.empty()) add_default(schema, field, *prepared);
  }
  classes_.emplace(&schema, std::move(prepared));
}

Dimension PreparedSchema::other_dimension(const ClassSchema& schema, const FieldSchema& field) {
  if (!field.other_unit) return {};
  const std::optional<Unit> unit = parse_unit(field.other_unit->unit);
  const FieldSchema* choice = schema.find(field.other_unit->field);
  const bool asked_for =
      choice != nullptr && std::ranges::count(choice->choices, field.other_unit->word) > 0;
  if (!unit || !asked_for || field.type != FieldType::number)
    problems_.push_back(schema.name + "." + field.name + ": its other unit is not one");
  return unit ? unit->dimension : Dimension{};
}

const Dimension& PreparedSchema::dimension(const Object& object, const FieldSchema& field) const {
  const PreparedClass& prepared = of(*object.schema);
  const auto index = static_cast<std::size_t>(&field - object.schema->fields.data());
  return object.in_other_unit(field) ? prepared.other_dimensions[index]
                                     : prepared.dimensions[index];
}

FieldContext PreparedSchema::context(const ClassSchema& schema, const FieldSchema& field,
                                     const ExpressionEvaluator& evaluator, Report& report) const {
  const PreparedClass& prepared = of(schema);
  const auto index = static_cast<std::size_t>(&field - schema.fields.data());
  return {field,  prepared.dimensions[index], prepared.other_dimensions[index], evaluator, report,
          &schema};
}

void PreparedSchema::check_names(const ClassSchema& schema) {
  const auto exists = [this](std::string_view pattern) {
    return std::ranges::any_of(schema_.classes(),
                               [&](const auto& entry) { return entry.first.starts_with(pattern); });
  };
  for (const std::string& child : schema.children) {
    if (!exists(child))
      problems_.push_back(schema.name + ": no class `" + child + "` to stand inside");
  }
  for (const FieldSchema& field : schema.fields) {
    if (field.type == FieldType::object &&
        !exists(field.refers_to.substr(0, field.refers_to.find('|')))) {
      problems_.push_back(schema.name + "." + field.name + ": refers to no class `" +
                          field.refers_to + "`");
    }
    if (field.type == FieldType::choice && field.choices.empty()) {
      problems_.push_back(schema.name + "." + field.name + ": a choice without choices");
    }
    if (std::ranges::count(schema.fields, field.name, &FieldSchema::name) > 1) {
      problems_.push_back(schema.name + "." + field.name + ": described twice");
    }
  }
  for (const std::string& port : {schema.default_input, schema.default_output}) {
    if (!port.empty() && schema.find(port) == nullptr)
      problems_.push_back(schema.name + ": no port `" + port + "`");
  }
}

namespace {

/// The field that `text`, `name = value`, gives it; nothing after errors.
std::optional<Field> make_alone(const SourceFile& text, const FieldSchema& field,
                                const Dimension& dimension, const Dimension& other_dimension,
                                Report& report) {
  ParsedFile file{text};
  parse_override(file);
  report.append(file.report);
  if (report.has_errors()) return std::nullopt;
  const Variables none;
  Budget budget;
  const ExpressionEvaluator evaluator(file, none, report, budget);
  return make_field({field, dimension, other_dimension, evaluator, report},
                    file.syntax.items[file.syntax.top.begin].value);
}

}  // namespace

void PreparedSchema::add_default(const ClassSchema& owner, const FieldSchema& field,
                                 PreparedClass& prepared) {
  const SourceFile& text = default_texts_.emplace_back(
      source_file("<default of " + owner.name + ">", field.name + " = " + field.default_text));
  Report report;
  std::optional<Field> made =
      make_alone(text, field, prepared.dimensions.back(), prepared.other_dimensions.back(), report);
  if (made && (field.type == FieldType::object || field.type == FieldType::port)) {
    report.error({}, "a reference cannot have a default");
  }
  if (made) prepared.defaults.push_back(std::move(*made));
  if (!report.has_errors()) return;
  Diagnostics diagnostics;
  report.deliver(diagnostics);
  problems_.push_back(owner.name + "." + field.name +
                      ": default: " + diagnostics.all().front().message);
}

std::vector<std::string> schema_problems(const Schema& schema) {
  return PreparedSchema(schema).problems();
}

std::optional<double> number_of(const std::string& text, const std::string& unit) {
  FieldSchema schema;
  schema.name = "value";
  schema.unit = unit;
  Report report;
  const std::optional<Field> field =
      make_alone(source_file("", schema.name + " = " + text), schema,
                 parse_unit(unit).value_or(Unit{}).dimension, {}, report);
  return field ? std::optional(field->numbers.front()) : std::nullopt;
}

}  // namespace hookpoint::language
