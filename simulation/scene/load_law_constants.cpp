// A contact law whose own constants no Material states runs at defaults that the user never saw.
#include <fmt/format.h>

#include <algorithm>
#include <set>
#include <string>
#include <vector>

#include "simulation/material_fields.h"
#include "simulation/scene/load_parts.h"

namespace hookpoint::simulation {
namespace {

struct OwnConstants {
  std::string_view law;
  std::vector<std::string_view> fields;  ///< that hookpoint does not read
  std::string_view stiffness_unit;       ///< where it is not that of the others
};

const std::vector<OwnConstants>& own_constants() {
  static const std::vector<OwnConstants> table{
      {"nominal", {"nominal_stiffness", "nominal_penetration"}, ""},
      {"hunt_crossley",
       {"exponent", "hysteresis_damping", "regularisation_speed", "stribeck_speed"},
       "N/m^exponent"},
      {"elastoplastic", {"breakaway"}, ""},
      {"exponential",
       {"exponential_force", "exponential_rate", "hysteresis_damping", "sliding_time"},
       ""},
      {"impulse", {"restitution", "rebound_speed"}, ""},
      {"impulse_reversal", {"restitution", "rebound_speed"}, ""},
  };
  return table;
}

std::string with_default(std::string_view name) {
  const auto fields = material_fields();
  const auto field = std::ranges::find(fields, name, &MaterialField::name);
  const std::string unit = field->unit;
  return fmt::format("{} ({:g}{})", name, contact::MaterialConstants<double>{}.*field->member,
                     unit.empty() ? "" : " " + unit);
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
  const auto own = std::ranges::find(own_constants(), experiment.contact, &OwnConstants::law);
  if (own == own_constants().end()) return;
  std::string constants;
  for (const std::string_view field : own->fields)
    constants += (constants.empty() ? "" : ", ") + with_default(field);
  const std::set<int> used = materials_in_use(*experiment.terrain);
  for (const auto& used_or_not : loading.materials) {
    if (!used.contains(used_or_not.second)) continue;
    const language::Object* const material = used_or_not.first;
    const bool states = material != nullptr && std::ranges::any_of(own->fields, [&](auto field) {
                          return material->given(field);
                        });
    if (states) continue;
    const std::string who =
        material == nullptr ? "the ground has no Material to state" : material->name + " states";
    loading.diagnostics.warning(
        material == nullptr ? world.position : material->position,
        fmt::format("law {} has constants of its own, and {} none of them: it takes {}{}; state "
                    "those that you mean",
                    own->law, who, constants,
                    own->stiffness_unit.empty()
                        ? ""
                        : fmt::format(", and normal_stiffness in {}", own->stiffness_unit)));
  }
}

}  // namespace hookpoint::simulation
