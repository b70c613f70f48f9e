#include "language/tree/object.h"

#include <algorithm>
#include <cassert>

namespace hookpoint::language {
namespace {

const Field* find_in(const std::vector<Field>& fields, std::string_view name) {
  const auto found = std::ranges::find_if(
      fields, [name](const Field& field) { return field.schema->name == name; });
  return found == fields.end() ? nullptr : &*found;
}

const Field& value_of(const Object& object, std::string_view name) {
  const Field* field = object.find(name);
  assert(field != nullptr && "a field that is neither given, required nor defaulted");
  return *field;
}

void collect(const Object& parent, std::string_view type, std::vector<const Object*>& found) {
  for (const std::unique_ptr<Object>& child : parent.children) {
    if (child->type == "Group") collect(*child, type, found);
    const bool family = type.ends_with('.') && child->type.starts_with(type);
    if (family || child->type == type) found.push_back(child.get());
  }
}

}  // namespace

const Field* Object::find(std::string_view field) const {
  const Field* own = find_in(fields, field);
  return own != nullptr || defaults == nullptr ? own : find_in(*defaults, field);
}

bool Object::given(std::string_view field) const { return find_in(fields, field) != nullptr; }

double Object::number(std::string_view field) const { return value_of(*this, field).numbers.at(0); }

const std::vector<double>& Object::numbers(std::string_view field) const {
  return value_of(*this, field).numbers;
}

const std::string& Object::word(std::string_view field) const {
  return value_of(*this, field).words.at(0);
}

bool Object::in_other_unit(const FieldSchema& field) const {
  if (!field.other_unit) return false;
  const Field* choice = find(field.other_unit->field);
  return choice != nullptr && !choice->words.empty() && choice->words[0] == field.other_unit->word;
}

const std::string& Object::unit_of(const FieldSchema& field) const {
  return in_other_unit(field) ? field.other_unit->unit : field.unit;
}

const Object* Object::object(std::string_view field) const {
  return value_of(*this, field).reference.object;
}

bool Object::boolean(std::string_view field) const {
  return value_of(*this, field).numbers.at(0) != 0.;
}

std::vector<const Object*> Object::children_of(std::string_view wanted) const {
  std::vector<const Object*> found;
  collect(*this, wanted, found);
  return found;
}

std::string Object::trail() const {
  std::string above = parent == nullptr ? "" : parent->trail();
  if (!above.empty() && !name.empty()) above += '.';
  return above + name;
}

}  // namespace hookpoint::language
