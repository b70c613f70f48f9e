// Material: the constants of contact laws on some tiles of the ground.
#include <fmt/format.h>

#include "simulation/material_fields.h"
#include "simulation/scene/fields.h"
#include "simulation/scene/load_parts.h"
#include "simulation/scene/schema.h"

namespace hookpoint::simulation {
namespace {

using Constants = contact::MaterialConstants<double>;

Field<Constants> described(const MaterialField& constant) {
  Field<Constants> field =
      number_field(constant.name, constant.unit, constant.member, constant.doc);
  field = constant.positive ? positive(std::move(field)) : not_negative(std::move(field));
  const bool friction = std::string_view(constant.name).ends_with("_friction");
  return at_most(constant.maximum, friction ? without_default(std::move(field)) : std::move(field));
}

const Fields<Constants>& constants_fields() {
  static const Fields<Constants> fields = [] {
    Fields<Constants> described_fields;
    for (const MaterialField& constant : material_fields())
      described_fields.push_back(described(constant));
    return described_fields;
  }();
  return fields;
}

/// Each coefficient of friction stands in for the other when only one is given.
void load_friction(const language::Object& object, contact::MaterialConstants<double>& constants,
                   Loading& loading) {
  const bool has_static = object.given(static_friction_field);
  const bool has_kinetic = object.given(kinetic_friction_field);
  if (has_static) constants.static_friction = object.number(static_friction_field);
  if (has_kinetic) constants.kinetic_friction = object.number(kinetic_friction_field);
  if (has_static && !has_kinetic) constants.kinetic_friction = constants.static_friction;
  if (has_kinetic && !has_static) constants.static_friction = constants.kinetic_friction;
  if (constants.kinetic_friction > constants.static_friction) {
    loading.error(
        place_of(object, kinetic_friction_field),
        fmt::format(
            "kinetic_friction {:g} is above static_friction {:g}: sliding would hold better than "
            "sticking; lower it or raise static_friction",
            constants.kinetic_friction, constants.static_friction));
  }
}

}  // namespace

void add_material_class(language::Schema& schema) {
  language::ClassSchema material;
  material.name = "Material";
  material.doc = "the surface of ground tiles; each contact law reads the constants that it knows";
  material.naming = language::Naming::required;
  material.top_level = true;
  material.fields = schemas(constants_fields());
  schema.add(std::move(material));
}

void load_materials(const language::Object& root, Loading& loading) {
  for (const language::Object* object : collect_all(root, "Material")) {
    MaterialSpec material{object->name, {}};
    store_fields(*object, constants_fields(), material.constants);
    load_friction(*object, material.constants, loading);
    loading.materials.emplace(object, static_cast<int>(loading.experiment.materials.size()));
    loading.experiment.materials.push_back(std::move(material));
  }
}

}  // namespace hookpoint::simulation
