#include "language/schema/schema.h"

#include <algorithm>
#include <cassert>

namespace hookpoint::language {
namespace {

std::string key_of(std::string_view name, std::string_view within) {
  return std::string(name) + " in " + std::string(within);
}

ClassSchema wire_class() {
  ClassSchema schema;
  schema.name = "Wire";
  schema.doc =
      "Carries one value from an output to an input: Wire FROM a TO b { rate = 200 Hz; delay = 20 "
      "ms; }";
  schema.naming = Naming::forbidden;
  FieldSchema rate;
  rate.name = wire_rate;
  rate.unit = "Hz";
  rate.minimum = 0.;
  rate.exclusive_minimum = true;
  rate.doc = "How often the value is sampled, then held; every step when not given.";
  FieldSchema delay;
  delay.name = wire_delay;
  delay.unit = "s";
  delay.minimum = 0.;
  delay.default_text = "0 s";
  delay.doc = "How much later a sample arrives.";
  FieldSchema noise;
  noise.name = wire_noise;
  noise.unit = "?";
  noise.minimum = 0.;
  noise.default_text = "0";
  noise.doc =
      "Standard deviation of the Gaussian noise added to each sample, in the unit of the value.";
  schema.fields = {rate, delay, noise};
  return schema;
}

ClassSchema group_class() {
  ClassSchema schema;
  schema.name = "Group";
  schema.doc =
      "Objects created under one name, as a named Include does; holds whatever its parent may "
      "hold.";
  schema.naming = Naming::required;
  schema.top_level = true;
  return schema;
}

}  // namespace

Schema::Schema() {
  add(wire_class());
  add(group_class());
}

const FieldSchema* ClassSchema::find(std::string_view field) const {
  const auto found = std::ranges::find(fields, field, &FieldSchema::name);
  return found == fields.end() ? nullptr : &*found;
}

void Schema::add(ClassSchema schema) {
  std::string name = schema.only_in.empty() ? schema.name : key_of(schema.name, schema.only_in);
  [[maybe_unused]] const bool added = classes_.emplace(std::move(name), std::move(schema)).second;
  assert(added && "a class is described once");
}

const ClassSchema* Schema::find(std::string_view name) const {
  const auto found = classes_.find(name);
  return found == classes_.end() ? nullptr : &found->second;
}

const ClassSchema* Schema::find(std::string_view name, std::string_view within) const {
  const ClassSchema* own = find(key_of(name, within));
  return own != nullptr ? own : find(name);
}

void Schema::add_reader(std::string extension, ForeignReader reader) {
  readers_.emplace(std::move(extension), std::move(reader));
}

const ForeignReader* Schema::find_reader(const std::string& extension) const {
  const auto found = readers_.find(extension);
  return found == readers_.end() ? nullptr : &found->second;
}

}  // namespace hookpoint::language
