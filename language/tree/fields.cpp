#include "language/tree/fields.h"

#include <fmt/format.h>

namespace hookpoint::language {

std::string default_text(double value) {
  std::string text = fmt::format("{}", value);
  const std::size_t padding = text.find("e-0");
  if (padding != std::string::npos) text.erase(padding + 2, 1);
  return text;
}

std::string default_text(std::span<const double> values) {
  std::string text;
  for (const double value : values) text += (text.empty() ? "" : ",") + default_text(value);
  return text;
}

std::string default_text(const Vector3d& value) {
  return fmt::format("{},{},{}", value.x, value.y, value.z);
}

std::string default_text(const Quaterniond& value) {
  return fmt::format("{},{},{},{}", value.w, value.x, value.y, value.z);
}

FieldSchema make_field(FieldType type, std::string_view name, std::string doc) {
  FieldSchema field;
  field.type = type;
  field.name = name;
  field.doc = std::move(doc);
  return field;
}

FieldSchema number_field(std::string_view name, std::string unit, std::string default_text,
                         std::string doc) {
  FieldSchema field = make_field(FieldType::number, name, std::move(doc));
  field.unit = std::move(unit);
  field.default_text = std::move(default_text);
  return field;
}

FieldSchema integer_field(std::string_view name, std::string default_text, std::string doc) {
  FieldSchema field = make_field(FieldType::integer, name, std::move(doc));
  field.default_text = std::move(default_text);
  return field;
}

FieldSchema boolean_field(std::string_view name, std::string default_text, std::string doc) {
  FieldSchema field = make_field(FieldType::boolean, name, std::move(doc));
  field.default_text = std::move(default_text);
  return field;
}

FieldSchema text_field(std::string_view name, std::string doc) {
  return make_field(FieldType::text, name, std::move(doc));
}

FieldSchema words_field(std::string_view name, int most, std::string doc) {
  FieldSchema field = make_field(FieldType::words, name, std::move(doc));
  field.max_count = most;
  return field;
}

FieldSchema formula_field(std::string_view name, std::string doc) {
  return make_field(FieldType::formula, name, std::move(doc));
}

FieldSchema list_field(std::string_view name, std::string unit, int min_count, int max_count,
                       std::string default_text, std::string doc) {
  FieldSchema field = number_field(name, std::move(unit), std::move(default_text), std::move(doc));
  field.type = FieldType::numbers;
  field.min_count = min_count;
  field.max_count = max_count;
  return field;
}

FieldSchema vector_field(std::string_view name, std::string unit, std::string default_text,
                         std::string doc) {
  return list_field(name, std::move(unit), 3, 3, std::move(default_text), std::move(doc));
}

FieldSchema orientation_field(std::string_view name, std::string doc) {
  return make_field(FieldType::orientation, name, std::move(doc));
}

FieldSchema choice_field(std::string_view name, std::vector<std::string> choices,
                         std::string default_text, std::string doc) {
  FieldSchema field = make_field(FieldType::choice, name, std::move(doc));
  field.choices = std::move(choices);
  field.default_text = std::move(default_text);
  return field;
}

FieldSchema object_field(std::string_view name, std::string refers_to, std::string doc) {
  FieldSchema field = make_field(FieldType::object, name, std::move(doc));
  field.refers_to = std::move(refers_to);
  return field;
}

FieldSchema port_only(Direction direction, FieldSchema field) {
  field.port = direction;
  field.setting = false;
  field.default_text.clear();
  return field;
}

}  // namespace hookpoint::language
