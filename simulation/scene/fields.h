// Words in which a class is described to the language: one call a field, with its unit, default and
// documentation.
#pragma once

#include <initializer_list>
#include <string>
#include <utility>

#include "language/schema/schema.h"

namespace hookpoint::simulation {

using language::Direction;
using language::FieldSchema;
using language::FieldType;

inline FieldSchema make_field(FieldType type, std::string name, std::string doc) {
  FieldSchema field;
  field.type = type;
  field.name = std::move(name);
  field.doc = std::move(doc);
  return field;
}
/// One quantity in `unit`; an empty `default_text` means that it has no default.
inline FieldSchema number_field(std::string name, std::string unit, std::string default_text,
                                std::string doc) {
  FieldSchema field = make_field(FieldType::number, std::move(name), std::move(doc));
  field.unit = std::move(unit);
  field.default_text = std::move(default_text);
  return field;
}
inline FieldSchema integer_field(std::string name, std::string default_text, std::string doc) {
  FieldSchema field = make_field(FieldType::integer, std::move(name), std::move(doc));
  field.default_text = std::move(default_text);
  return field;
}
inline FieldSchema boolean_field(std::string name, std::string default_text, std::string doc) {
  FieldSchema field = make_field(FieldType::boolean, std::move(name), std::move(doc));
  field.default_text = std::move(default_text);
  return field;
}
inline FieldSchema text_field(std::string name, std::string doc) {
  return make_field(FieldType::text, std::move(name), std::move(doc));
}
/// `min_count` to `max_count` quantities in `unit`.
inline FieldSchema list_field(std::string name, std::string unit, int min_count, int max_count,
                              std::string default_text, std::string doc) {
  FieldSchema field =
      number_field(std::move(name), std::move(unit), std::move(default_text), std::move(doc));
  field.type = FieldType::numbers;
  field.min_count = min_count;
  field.max_count = max_count;
  return field;
}
inline FieldSchema vector_field(std::string name, std::string unit, std::string default_text,
                                std::string doc) {
  return list_field(std::move(name), std::move(unit), 3, 3, std::move(default_text),
                    std::move(doc));
}
inline FieldSchema orientation_field(std::string name, std::string doc) {
  FieldSchema field = make_field(FieldType::orientation, std::move(name), std::move(doc));
  field.default_text = "1,0,0,0";
  return field;
}
inline FieldSchema choice_field(std::string name, std::vector<std::string> choices,
                                std::string default_text, std::string doc) {
  FieldSchema field = make_field(FieldType::choice, std::move(name), std::move(doc));
  field.choices = std::move(choices);
  field.default_text = std::move(default_text);
  return field;
}
/// A reference to an object whose class begins with `refers_to`.
inline FieldSchema object_field(std::string name, std::string refers_to, std::string doc) {
  FieldSchema field = make_field(FieldType::object, std::move(name), std::move(doc));
  field.refers_to = std::move(refers_to);
  return field;
}

/// `word` may stand for the number.
inline FieldSchema or_word(std::string word, FieldSchema field) {
  field.choices.push_back(std::move(word));
  return field;
}

/// In `unit` where the choice `field` is `word`.
inline FieldSchema or_unit(std::string unit, std::string field, std::string word,
                           FieldSchema described) {
  described.other_unit = {std::move(field), std::move(word), std::move(unit)};
  return described;
}

inline FieldSchema required(FieldSchema field) {
  field.required = true;
  return field;
}
inline FieldSchema positive(FieldSchema field) {
  field.minimum = 0.;
  field.exclusive_minimum = true;
  return field;
}
inline FieldSchema at_least(double minimum, FieldSchema field) {
  field.minimum = minimum;
  return field;
}
inline FieldSchema between(double minimum, double maximum, FieldSchema field) {
  field.minimum = minimum;
  field.maximum = maximum;
  return field;
}
inline FieldSchema not_negative(FieldSchema field) { return at_least(0., std::move(field)); }

/// A setting that wires can read (output), write (input), or both.
inline FieldSchema with_port(Direction direction, FieldSchema field) {
  field.port = direction;
  return field;
}
/// A port that no file can assign.
inline FieldSchema port_only(Direction direction, FieldSchema field) {
  field.port = direction;
  field.setting = false;
  field.default_text.clear();
  return field;
}

/// Appends `more` to `list`.
template <class Element>
void append(std::vector<Element>& list, std::vector<Element> more) {
  for (Element& element : more) list.push_back(std::move(element));
}

}  // namespace hookpoint::simulation
