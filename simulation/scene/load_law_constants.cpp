// The constants of the chosen contact law, and those that a Material states: a law whose own
// constants no Material states runs at defaults that the user never saw; a constant that the law
// does not read does nothing.
#include <fmt/format.h>

#include <algorithm>
#include <set>
#include <string>
#include <vector>

#include "contact/force_law.h"
#include "contact/laws/surface_forces.h"
#include "language/names.h"
#include "simulation/experiment/material_fields.h"
#include "simulation/scene/load_parts.h"
#include "simulation/scene/unread_constants.h"

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

/// The law of our engine on its ground; null where neither is.
const contact::LawDescription* chosen_law(const Loading& loading) {
  const Experiment& experiment = loading.experiment;
  if (experiment.engine != "dts" || !experiment.terrain) return nullptr;
  return contact::find_law(experiment.contact);
}

/// Materials that shapes, points and bodies name, and those of Pairs.
std::set<int> foot_materials_in_use(const language::Object& world, Loading& loading) {
  std::set<int> used;
  for (const char* type : {"Shape.", "ContactPoint", "Link", "Base."})
    for (const language::Object* object : collect_all(world, type))
      used.insert(foot_material(*object, no_material, loading));
  for (const PairSpec& pair : loading.experiment.pairs) used.insert(pair.material);
  used.erase(no_material);
  return used;
}

/// Materials as written, by their indices; null for the defaults of a ground without one.
std::vector<const language::Object*> written(const std::set<int>& materials,
                                             const Loading& loading) {
  std::vector<const language::Object*> found;
  for (const int used : materials)
    for (const auto& [material, index] : loading.materials)
      if (index == used) found.push_back(material);
  return found;
}

void check_unstated(const contact::LawDescription& law, const language::Object& world,
                    const language::Object* material, Loading& loading) {
  if (law.own_constants.size() == 0) return;
  const bool states =
      material != nullptr && std::ranges::any_of(law.own_constants, [&](auto constant) {
        return material->given(field_of(constant).name);
      });
  if (states) return;
  std::string constants;
  for (const contact::Constant constant : law.own_constants)
    constants += (constants.empty() ? "" : ", ") + with_default(field_of(constant));
  const std::string who =
      material == nullptr ? "the ground has no Material to state" : material->name + " states";
  loading.diagnostics.warning(
      material == nullptr ? world.position : material->position,
      fmt::format("law {} has constants of its own, and {} none of them: it takes {}{}; state "
                  "those that you mean",
                  law.name, who, constants, stiffness_unit(law.normal_constants)));
}

bool law_reads(const contact::LawDescription& law, contact::Constant constant) {
  // Beside every force law act the constants of surfaces.
  return std::ranges::count(law.constants, constant) > 0 ||
         (!law.is_impulse_law && std::ranges::count(contact::surface_constants, constant) > 0);
}

/// Whether a coefficient of friction changes nothing by itself: it is the other one too, or equal
/// to it.
bool is_the_only_friction(const language::Object& material, const MaterialField& field) {
  const std::string_view name = field.name;
  if (name != static_friction_field && name != kinetic_friction_field) return false;
  return !material.given(static_friction_field) || !material.given(kinetic_friction_field) ||
         material.number(static_friction_field) == material.number(kinetic_friction_field);
}

/// Constants of the Material that its user means for this run and that the law does not read:
/// stated in the World's own file, not in one that it includes, which may serve many laws. Where a
/// study or the command line chooses the law, only those that it states too.
std::vector<contact::Constant> unread_constants(const contact::LawDescription& law,
                                                const language::Object& world,
                                                const language::Object& material) {
  const bool chosen_outside = set_from_outside(world, "contact");
  std::vector<contact::Constant> unread;
  for (const MaterialField& field : material_fields()) {
    if (!material.given(field.name) || law_reads(law, field.member) ||
        is_the_only_friction(material, field))
      continue;
    const bool stated_outside = set_from_outside(material, field.name);
    const bool stated_here =
        material.find(field.name)->position.file == world.position.file && !chosen_outside;
    if (stated_outside || stated_here) unread.push_back(field.member);
  }
  return unread;
}

/// Says so where other laws read them all; a Material whose constants no one law reads is written
/// for several.
void check_unread(const contact::LawDescription& law, const language::Object& world,
                  const language::Object& material, Loading& loading) {
  const std::vector<contact::Constant> unread = unread_constants(law, world, material);
  if (unread.empty()) return;
  std::vector<std::string> names, readers;
  for (const contact::Constant constant : unread)
    names.push_back(fmt::format("`{}`", field_of(constant).name));
  for (const contact::LawDescription& other : contact::law_table()) {
    if (std::ranges::all_of(unread, [&](auto constant) { return law_reads(other, constant); }))
      readers.emplace_back(other.name);
  }
  if (readers.empty()) return;
  const bool one = names.size() == 1;
  loading.diagnostics.warning(
      place_of(material, field_of(unread.front()).name),
      fmt::format("{} {} not read by contact law {}: {} nothing in this run; laws that read {}: {}",
                  language::join(names, ", "), one ? "is" : "are", law.name,
                  one ? "it changes" : "they change", one ? "it" : "them",
                  language::join(readers, ", ")));
}

}  // namespace

void warn_of_unstated_constants(const language::Object& world, Loading& loading) {
  const contact::LawDescription* law = chosen_law(loading);
  if (law == nullptr) return;
  for (const language::Object* material :
       written(materials_in_use(*loading.experiment.terrain), loading))
    check_unstated(*law, world, material, loading);
}

void warn_of_unread_constants(const language::Object& world, Loading& loading) {
  const contact::LawDescription* law = chosen_law(loading);
  if (law == nullptr) return;
  std::set<int> used = materials_in_use(*loading.experiment.terrain);
  used.merge(foot_materials_in_use(world, loading));
  for (const language::Object* material : written(used, loading))
    if (material != nullptr) check_unread(*law, world, *material, loading);
}

}  // namespace hookpoint::simulation
