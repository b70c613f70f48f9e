// A contact law whose own constants no Material states runs at defaults that the user never saw.
#include <fmt/format.h>

#include <algorithm>
#include <set>
#include <string>

#include "contact/force_law.h"
#include "simulation/material_fields.h"
#include "simulation/scene/load_parts.h"

namespace hookpoint::simulation {
namespace {

std::string with_default(const MaterialField& field) {
  const std::string unit = field.unit;
  return fmt::format("{} ({:g}{})", field.name, contact::Constants{}.*field.member,
                     unit.empty() ? "" : " " + unit);
}

/// ", and normal_stiffness in N/m^exponent" where the law reads its stiffness in a unit that the
/// field does not have.
std::string stiffness_unit(const contact::NormalConstants& constants) {
  if (constants.stiffness == nullptr) return "";
  const MaterialField field = field_of(constants.stiffness);
  if (constants.stiffness_unit == field.unit) return "";
  return fmt::format(", and {} in {}", field.name, constants.stiffness_unit);
}

std::set<int> materials_in_use(const TerrainSpec& terrain) {
  std::set<int> used{terrain.material};
  for (const PatchSpec& patch : terrain.patches) used.insert(patch.material);
  return used;
}

}  // namespace

void warn_of_unstated_constants(const language::Object& world, Loading& loading) {
  const Experiment& experiment = loading.experiment;
  if (experiment.engine != "dts" || !experiment.terrain) return;
  const contact::LawDescription* law = contact::find_law(experiment.contact);
  if (law == nullptr || law->own_constants.size() == 0) return;
  std::string constants;
  for (const contact::Constant constant : law->own_constants)
    constants += (constants.empty() ? "" : ", ") + with_default(field_of(constant));
  const std::set<int> used = materials_in_use(*experiment.terrain);
  for (const auto& used_or_not : loading.materials) {
    if (!used.contains(used_or_not.second)) continue;
    const language::Object* const material = used_or_not.first;
    const bool states =
        material != nullptr && std::ranges::any_of(law->own_constants, [&](auto constant) {
          return material->given(field_of(constant).name);
        });
    if (states) continue;
    const std::string who =
        material == nullptr ? "the ground has no Material to state" : material->name + " states";
    loading.diagnostics.warning(
        material == nullptr ? world.position : material->position,
        fmt::format("law {} has constants of its own, and {} none of them: it takes {}{}; state "
                    "those that you mean",
                    law->name, who, constants, stiffness_unit(law->along_normal)));
  }
}

}  // namespace hookpoint::simulation
