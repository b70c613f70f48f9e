// Words in which a class declares its fields, one call a field: name, unit, where its value goes,
// range, documentation. The schema (checking, `describe`, the manual) and the load step both come
// of that one declaration. Where a field's value is only kept, the call names the member of the
// loaded struct that takes it, and the member's own initialiser is the field's default; a field
// without a member is a port, or one that the class's loader works with itself.
#pragma once

#include <algorithm>
#include <array>
#include <concepts>
#include <functional>
#include <optional>
#include <span>
#include <string>
#include <string_view>
#include <type_traits>
#include <utility>
#include <vector>

#include "language/schema/schema.h"
#include "language/tree/object.h"
#include "math/rotation.h"

namespace hookpoint::language {

/// A field of a class whose objects are loaded into a `Spec`.
template <class Spec>
struct LoadedField : FieldSchema {
  LoadedField(FieldSchema schema) : FieldSchema(std::move(schema)) {}
  /// A field of a base of `Spec`.
  template <class Base>
  requires std::derived_from<Spec, Base> LoadedField(LoadedField<Base> field)
      : FieldSchema(field), store(std::move(field.store)) {}
  /// Puts a value that a file gives into the member; empty without a member.
  std::function<void(const Field& given, Spec& spec)> store;
};
/// In the order of the manual.
template <class Spec>
using Fields = std::vector<LoadedField<Spec>>;

/// Puts what the object gives into `spec`; what it leaves out stays as it is.
template <class Spec>
void store_fields(const Object& object, const Fields<Spec>& fields, Spec& spec) {
  for (const LoadedField<Spec>& field : fields) {
    if (field.store && object.given(field.name)) field.store(*object.find(field.name), spec);
  }
}
/// An object as a `Spec`, whose own initialisers hold where it gives nothing.
template <class Spec>
Spec load_fields(const Object& object, const Fields<Spec>& fields) {
  Spec spec;
  store_fields(object, fields, spec);
  return spec;
}

/// Appends `more` to `list`; fields with members to a class's schema, too.
template <class Element, class Other>
void append(std::vector<Element>& list, const std::vector<Other>& more) {
  list.insert(list.end(), more.begin(), more.end());
}
template <class Element>
void append(std::vector<Element>& list, std::initializer_list<Element> more) {
  list.insert(list.end(), more);
}
template <class Spec>
std::vector<FieldSchema> schemas(const Fields<Spec>& fields) {
  return {fields.begin(), fields.end()};
}

/// A value with its place in the file, for what is checked against other blocks later on. The
/// object that it was loaded from outlives it.
template <class Value>
struct Placed {
  std::optional<Value> value;    ///< nothing: the file leaves it out, and there is no default
  const Field* field = nullptr;  ///< null: the file leaves it out

  Placed() = default;
  Placed(Value initial) : value(std::move(initial)) {}
  explicit operator bool() const { return value.has_value(); }
  const Value& operator*() const { return *value; }
  const Value* operator->() const { return &*value; }
  bool given() const { return field != nullptr; }
  /// Of a given one.
  const Position& position() const { return field->position; }
  Position position_or(const Position& otherwise) const {
    return given() ? field->position : otherwise;
  }
};

// How a value goes into a member of each type.

/// A word may stand in a number's place (deltat = auto); it leaves the member as it is.
inline void assign(const Field& given, double& member) {
  if (!given.numbers.empty()) member = given.numbers[0];
}
inline void assign(const Field& given, std::optional<double>& member) { member = given.numbers[0]; }
template <std::integral Integer>
void assign(const Field& given, Integer& member) {
  member = static_cast<Integer>(given.numbers[0]);
}
inline void assign(const Field& given, Vector3d& member) {
  member = {given.numbers[0], given.numbers[1], given.numbers[2]};
}
inline void assign(const Field& given, Quaterniond& member) {
  member = {given.numbers[0], given.numbers[1], given.numbers[2], given.numbers[3]};
}
/// Fewer numbers than the array has leave the others as they are.
template <std::size_t count>
void assign(const Field& given, std::array<double, count>& member) {
  std::ranges::copy(given.numbers, member.begin());
}
inline void assign(const Field& given, std::string& member) { member = given.words[0]; }
inline void assign(const Field& given, std::vector<std::string>& member) { member = given.words; }
/// The field itself: numbers or words, a formula.
inline void assign(const Field& given, const Field*& member) { member = &given; }
/// The choices are the enumerators in their order.
template <class Enumeration>
requires std::is_enum_v<Enumeration>
void assign(const Field& given, Enumeration& member) {
  const std::vector<std::string>& choices = given.schema->choices;
  member = static_cast<Enumeration>(std::ranges::find(choices, given.words[0]) - choices.begin());
}
template <class Value>
void assign(const Field& given, Placed<Value>& member) {
  Value value{};
  assign(given, value);
  member.value = std::move(value);
  member.field = &given;
}

// A member's initial value as the language writes it; "" is no default.

std::string default_text(double value);  ///< 1e-6, 0.001, 100000
inline std::string default_text(const std::optional<double>&) { return ""; }
template <std::integral Integer>
std::string default_text(Integer value) {
  return std::to_string(value);
}
std::string default_text(std::span<const double> values);  ///< 0.02,1
template <std::size_t count>
std::string default_text(const std::array<double, count>& values) {
  return default_text(std::span<const double>(values));
}
std::string default_text(const Vector3d& value);     ///< 0,0,0
std::string default_text(const Quaterniond& value);  ///< 1,0,0,0
inline std::string default_text(const std::string& value) { return value; }
inline std::string default_text(bool value) { return value ? "true" : "false"; }
inline std::string default_text(const std::vector<std::string>&) { return ""; }
inline std::string default_text(const Field*) { return ""; }

/// The same of a field that has choices, where the value may be an enumerator.
template <class Value>
std::string default_text(const FieldSchema& schema, const Value& initial) {
  if constexpr (std::is_enum_v<Value>)
    return schema.choices[static_cast<std::size_t>(initial)];
  else
    return default_text(initial);
}
template <class Value>
std::string default_text(const FieldSchema& schema, const Placed<Value>& initial) {
  return initial ? default_text(schema, *initial) : "";
}

/// The field that `schema` describes, kept in `member`.
template <class Spec, class Value>
LoadedField<Spec> kept(Value Spec::*member, FieldSchema schema) {
  LoadedField<Spec> field(std::move(schema));
  field.default_text = default_text(field, Spec{}.*member);
  field.store = [member](const Field& given, Spec& spec) { assign(given, spec.*member); };
  return field;
}

// Fields of each type: with the text of a default ("" for none), or with the member that takes the
// value.

FieldSchema make_field(FieldType type, std::string_view name, std::string doc);

/// One quantity in `unit`.
FieldSchema number_field(std::string_view name, std::string unit, std::string default_text,
                         std::string doc);
template <class Spec, class Value>
LoadedField<Spec> number_field(std::string_view name, std::string unit, Value Spec::*member,
                               std::string doc) {
  return kept(member, number_field(name, std::move(unit), "", std::move(doc)));
}
FieldSchema integer_field(std::string_view name, std::string default_text, std::string doc);
template <class Spec, class Value>
LoadedField<Spec> integer_field(std::string_view name, Value Spec::*member, std::string doc) {
  return kept(member, integer_field(name, "", std::move(doc)));
}
FieldSchema boolean_field(std::string_view name, std::string default_text, std::string doc);
template <class Spec, class Value>
LoadedField<Spec> boolean_field(std::string_view name, Value Spec::*member, std::string doc) {
  return kept(member, boolean_field(name, "", std::move(doc)));
}
FieldSchema text_field(std::string_view name, std::string doc);
template <class Spec, class Value>
LoadedField<Spec> text_field(std::string_view name, Value Spec::*member, std::string doc) {
  return kept(member, text_field(name, std::move(doc)));
}
/// 1 to `most` bare words or strings.
FieldSchema words_field(std::string_view name, int most, std::string doc);
/// Kept as words, or as the first of them.
template <class Spec, class Value>
LoadedField<Spec> words_field(std::string_view name, int most, Value Spec::*member,
                              std::string doc) {
  return kept(member, words_field(name, most, std::move(doc)));
}
/// An expression of names that get their values later.
FieldSchema formula_field(std::string_view name, std::string doc);
template <class Spec>
LoadedField<Spec> formula_field(std::string_view name, const Field* Spec::*member,
                                std::string doc) {
  return kept(member, formula_field(name, std::move(doc)));
}
/// `min_count` to `max_count` quantities in `unit`.
FieldSchema list_field(std::string_view name, std::string unit, int min_count, int max_count,
                       std::string default_text, std::string doc);
template <class Spec>
LoadedField<Spec> list_field(std::string_view name, std::string unit, int min_count, int max_count,
                             const Field* Spec::*member, std::string doc) {
  return kept(member, list_field(name, std::move(unit), min_count, max_count, "", std::move(doc)));
}
/// As many as the array has, or fewer.
template <class Spec, std::size_t most>
LoadedField<Spec> list_field(std::string_view name, std::string unit, int min_count,
                             std::array<double, most> Spec::*member, std::string doc) {
  return kept(member, list_field(name, std::move(unit), min_count, static_cast<int>(most), "",
                                 std::move(doc)));
}
FieldSchema vector_field(std::string_view name, std::string unit, std::string default_text,
                         std::string doc);
template <class Spec>
LoadedField<Spec> vector_field(std::string_view name, std::string unit, Vector3d Spec::*member,
                               std::string doc) {
  return kept(member, vector_field(name, std::move(unit), "", std::move(doc)));
}
FieldSchema orientation_field(std::string_view name, std::string doc);
template <class Spec>
LoadedField<Spec> orientation_field(std::string_view name, Quaterniond Spec::*member,
                                    std::string doc) {
  return kept(member, orientation_field(name, std::move(doc)));
}
FieldSchema choice_field(std::string_view name, std::vector<std::string> choices,
                         std::string default_text, std::string doc);
/// Kept as its word, or as an enumerator: the choices are then the enumerators in their order.
template <class Spec, class Value>
LoadedField<Spec> choice_field(std::string_view name, std::vector<std::string> choices,
                               Value Spec::*member, std::string doc) {
  return kept(member, choice_field(name, std::move(choices), "", std::move(doc)));
}
/// A reference to an object whose class begins with `refers_to`.
FieldSchema object_field(std::string_view name, std::string refers_to, std::string doc);

// What more there is to say of a field, around the call that describes it.

/// `word` may stand for the number.
template <class Described>
Described or_word(std::string word, Described field) {
  field.choices.push_back(std::move(word));
  return field;
}
/// Words or strings may stand in the place of numbers.
template <class Described>
Described or_words(Described field) {
  field.or_words = true;
  return field;
}
/// In `unit` where the choice `choice` is `word`.
template <class Described>
Described or_unit(std::string unit, std::string choice, std::string word, Described field) {
  field.other_unit = {std::move(choice), std::move(word), std::move(unit)};
  return field;
}
/// Left out, it means something that its documentation says.
template <class Described>
Described without_default(Described field) {
  field.default_text.clear();
  return field;
}
template <class Described>
Described required(Described field) {
  field.required = true;
  return without_default(std::move(field));
}
template <class Described>
Described positive(Described field) {
  field.minimum = 0.;
  field.exclusive_minimum = true;
  return field;
}
template <class Described>
Described at_least(double minimum, Described field) {
  field.minimum = minimum;
  return field;
}
template <class Described>
Described at_most(double maximum, Described field) {
  field.maximum = maximum;
  return field;
}
template <class Described>
Described between(double minimum, double maximum, Described field) {
  return at_least(minimum, at_most(maximum, std::move(field)));
}
template <class Described>
Described not_negative(Described field) {
  return at_least(0., std::move(field));
}

/// A setting that wires can read (output), write (input), or both.
template <class Described>
Described with_port(Direction direction, Described field) {
  field.port = direction;
  return field;
}
/// A port that no file can assign.
FieldSchema port_only(Direction direction, FieldSchema field);

}  // namespace hookpoint::language
