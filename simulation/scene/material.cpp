// Material: the constants of contact laws on some tiles of the ground.
#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <optional>

#include "language/tree/fields.h"
#include "simulation/experiment/material_fields.h"
#include "simulation/scene/body.h"
#include "simulation/scene/load_parts.h"
#include "simulation/scene/schema.h"

namespace hookpoint::simulation {

using language::append;
using language::choice_field;
using language::Fields;
using language::FieldSchema;
using language::list_field;
using language::LoadedField;
using language::number_field;
using language::object_field;

namespace {

using Constants = contact::MaterialConstants<double>;

LoadedField<Constants> described(const MaterialField& constant) {
  LoadedField<Constants> field =
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

/// What a Material states in MuJoCo's words. The initialisers are MuJoCo's own defaults.
struct MujocoFields {
  std::array<double, 2> solref = contact::MujocoRow{}.reference;
  std::array<double, 5> solimp = contact::MujocoRow{}.impedance;
  double impratio = contact::MujocoFriction{}.impedance_ratio;
  enum class Cone { pyramidal, elliptic } cone = Cone::pyramidal;
};
constexpr const char* solref_field = "solref";

const Fields<MujocoFields>& mujoco_fields() {
  static const Fields<MujocoFields> fields{
      list_field(solref_field, "", 2, &MujocoFields::solref,
                 "MuJoCo's time constant [s] and damping ratio, or, both below 0, -stiffness and "
                 "-damping per mass. The first four constants that are not stated are then "
                 "those which stand and rebound so under the load at the start; mujoco and "
                 "mujoco_3_14 take the numbers themselves at `settings = file`"),
      not_negative(list_field("solimp", "", 3, &MujocoFields::solimp,
                              "MuJoCo's impedances at the surface and from the width on, width "
                              "[m], midpoint and power; with solref")),
      positive(number_field("impratio", "", &MujocoFields::impratio,
                            "MuJoCo's ratio of normal to frictional softness, one for a World; "
                            "with solref")),
      choice_field("cone", {"pyramidal", "elliptic"}, &MujocoFields::cone,
                   "of MuJoCo's friction, one for a World; with solref"),
  };
  return fields;
}

std::optional<contact::MujocoContact> load_mujoco(const language::Object& object,
                                                  Loading& loading) {
  const auto is_given = [&](const auto& field) { return object.given(field.name); };
  if (std::ranges::none_of(mujoco_fields(), is_given)) return std::nullopt;
  const auto given = language::load_fields(object, mujoco_fields());
  if (!contact::is_mujoco_reference(given.solref))
    loading.error(place_of(object, solref_field), contact::mujoco_reference_rule);
  return contact::MujocoContact{{given.solref, given.solimp},
                                {given.cone == MujocoFields::Cone::elliptic, given.impratio}};
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
  if (constants.friction_across > 0. && constants.kinetic_friction == 0.) {
    loading.error(place_of(object, friction_across_field),
                  "friction_across has no ratio to a kinetic_friction of 0; give kinetic_friction "
                  "a small value");
  }
  if (constants.kinetic_friction > constants.static_friction) {
    loading.error(
        place_of(object, kinetic_friction_field),
        fmt::format(
            "kinetic_friction {:g} is above static_friction {:g}: sliding would hold better than "
            "sticking; lower it or raise static_friction",
            constants.kinetic_friction, constants.static_friction));
  }
}

/// The constants that the file leaves at their defaults. A coefficient of friction states both.
std::vector<double Constants::*> unstated(const language::Object& object) {
  const bool friction = object.given(static_friction_field) || object.given(kinetic_friction_field);
  std::vector<double Constants::*> constants;
  for (const MaterialField& field : material_fields()) {
    const bool is_friction = field.member == &Constants::static_friction ||
                             field.member == &Constants::kinetic_friction ||
                             field.member == &Constants::friction_across;
    if (!object.given(field.name) && !(is_friction && friction)) constants.push_back(field.member);
  }
  return constants;
}

/// One of the two materials of a Pair, and what they make.
namespace pair_field {
constexpr const char *a = "a", *b = "b", *material = "material";
}

}  // namespace

void add_material_class(language::Schema& schema) {
  language::ClassSchema material;
  material.name = "Material";
  material.doc = "the surface of ground tiles; each contact law reads the constants that it knows";
  material.naming = language::Naming::required;
  material.top_level = true;
  material.fields = schemas(constants_fields());
  append(material.fields, schemas(mujoco_fields()));
  schema.add(std::move(material));
  language::ClassSchema pair;
  pair.name = "Pair";
  pair.doc = "what contacts between two materials have instead of what `combine` makes of them";
  pair.top_level = true;
  pair.fields = {
      required(object_field(pair_field::a, "Material", "of one side, foot or ground")),
      required(object_field(pair_field::b, "Material", "of the other side")),
      required(object_field(pair_field::material, "Material",
                            "whose constants their contacts have, all of them")),
  };
  schema.add(std::move(pair));
}

FieldSchema foot_material_field(const std::string& whose) {
  return object_field(material_field, "Material",
                      "of its surface" + whose +
                          "; with the ground's it makes what the contact law reads (`combine` of "
                          "the World); if not given, the ground's alone");
}

MaterialSpec default_material() {
  MaterialSpec material{"default", {}, {}};
  for (const MaterialField& field : material_fields()) material.unstated.push_back(field.member);
  return material;
}

int foot_material(const language::Object& object, int otherwise, Loading& loading) {
  const language::Field* field = object.find(material_field);
  if (field == nullptr) return otherwise;
  const auto at = loading.materials.find(field->reference.object);
  return at == loading.materials.end() ? otherwise : at->second;
}

void load_materials(const language::Object& root, Loading& loading) {
  for (const language::Object* object : collect_all(root, "Material")) {
    MaterialSpec material{object->name, {}, {}};
    store_fields(*object, constants_fields(), material.constants);
    load_friction(*object, material.constants, loading);
    material.unstated = unstated(*object);
    material.mujoco = load_mujoco(*object, loading);
    loading.materials.emplace(object, static_cast<int>(loading.experiment.materials.size()));
    loading.experiment.materials.push_back(std::move(material));
  }
  const auto material_at = [&](const language::Object& pair, const char* field) {
    return loading.materials.at(pair.find(field)->reference.object);
  };
  for (const language::Object* pair : collect_all(root, "Pair")) {
    loading.experiment.pairs.push_back({material_at(*pair, pair_field::a),
                                        material_at(*pair, pair_field::b),
                                        material_at(*pair, pair_field::material)});
  }
}

}  // namespace hookpoint::simulation
