// The constants of the chosen contact law, and those that a Material states: a law whose own
// constants no Material states runs at defaults that the user never saw; a constant that the law
// does not read does nothing.
#include <fmt/format.h>

#include <algorithm>
#include <map>
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

/// Whether anything can touch: on a terrain, on an obstacle, or as shapes of robots.
bool has_contact(const language::Object& world, const Loading& loading) {
  if (loading.experiment.terrain || !world.children_of("Obstacle.").empty()) return true;
  if (loading.experiment.touch != "shapes") return false;
  const auto robots = world.children_of("Robot");
  return robots.size() > 1 || std::ranges::any_of(robots, [](const language::Object* robot) {
           return robot->boolean("self_contact");
         });
}

/// The law of our engine; null of another, and where nothing can touch.
const contact::LawDescription* chosen_law(const language::Object& world, const Loading& loading) {
  const Experiment& experiment = loading.experiment;
  if (experiment.engine != "dts" || !has_contact(world, loading)) return nullptr;
  return contact::find_law(experiment.contact);
}

/// Materials that shapes, points, bodies and obstacles name, and those of Pairs.
std::set<int> foot_materials_in_use(const language::Object& world, Loading& loading) {
  std::set<int> used;
  for (const char* type : {"Shape.", "ContactPoint", "Link", "Base.", "Obstacle."})
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

/// Materials of the terrain and of obstacles; where there are neither, those of feet. What states none
/// has the terrain's, without a terrain the World's first (ContactMaterials::between); no_material: of
/// neither.
std::set<int> ground_materials(const language::Object& world, Loading& loading) {
  const Experiment& experiment = loading.experiment;
  std::set<int> used;
  if (experiment.terrain) used = materials_in_use(*experiment.terrain);
  const int unstated = experiment.terrain             ? experiment.terrain->material
                       : experiment.materials.empty() ? no_material
                                                      : 0;
  for (const language::Object* obstacle : world.children_of("Obstacle."))
    used.insert(foot_material(*obstacle, unstated, loading));
  if (used.empty()) used = foot_materials_in_use(world, loading);
  return used;
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

/// Whether the Material is written for whatever law a run has: it states a constant of its own of each
/// law that has some.
bool is_for_every_law(const language::Object& material) {
  return std::ranges::all_of(contact::law_table(), [&](const contact::LawDescription& law) {
    return law.own_constants.size() == 0 ||
           std::ranges::any_of(law.own_constants, [&](auto constant) {
             return material.given(field_of(constant).name);
           });
  });
}

/// Constants of the Material that its user means for this run, `reads` those that it reads anyway.
/// None of them where the Material is written for every law and none was set from outside.
template <class Reads>
std::vector<contact::Constant> unread_constants(const language::Object& material,
                                                const Loading& loading, const Reads& reads) {
  std::vector<contact::Constant> unread;
  bool set = false;
  for (const MaterialField& field : material_fields()) {
    if (!material.given(field.name) || reads(field.member) || is_the_only_friction(material, field))
      continue;
    const bool set_here = set_from_outside(material, field.name);
    if (set_here || !loading.serves_study) unread.push_back(field.member);
    set = set || set_here;
  }
  if (!set && is_for_every_law(material)) unread.clear();
  return unread;
}

std::string laws_reading(const std::vector<contact::Constant>& constants) {
  std::vector<std::string> laws;
  for (const contact::LawDescription& law : contact::law_table()) {
    if (std::ranges::all_of(constants, [&](auto constant) { return law_reads(law, constant); }))
      laws.emplace_back(law.name);
  }
  return language::join(laws, ", ");
}

/// "laws that read it: impulse"; of constants that no one law reads those of each.
std::string who_reads(const std::vector<contact::Constant>& constants) {
  const std::string all = laws_reading(constants);
  if (!all.empty())
    return fmt::format("laws that read {}: {}", constants.size() == 1 ? "it" : "them", all);
  std::map<std::string, std::vector<contact::Constant>> by_laws;
  for (const contact::Constant constant : constants)
    by_laws[laws_reading({constant})].push_back(constant);
  std::vector<std::string> groups;
  for (const auto& [laws, read] : by_laws) groups.push_back(quoted_fields(read) + ": " + laws);
  return "laws that read " + language::join(groups, "; ");
}

void check_unread(const contact::LawDescription& law, const language::Object& material,
                  Loading& loading) {
  const std::vector<contact::Constant> unread =
      unread_constants(material, loading, [&](auto constant) { return law_reads(law, constant); });
  if (unread.empty()) return;
  const bool one = unread.size() == 1;
  loading.diagnostics.warning(
      place_of(material, field_of(unread.front()).name),
      fmt::format("{} {} not read by contact law {}: {} nothing in this run; {}",
                  quoted_fields(unread), one ? "is" : "are", law.name,
                  one ? "it changes" : "they change", who_reads(unread)));
}

}  // namespace

void warn_of_unstated_constants(const language::Object& world, Loading& loading) {
  const contact::LawDescription* law = chosen_law(world, loading);
  if (law == nullptr) return;
  const std::set<int> used = ground_materials(world, loading);
  for (const language::Object* material : written(used, loading))
    check_unstated(*law, world, material, loading);
  if (used.contains(no_material)) check_unstated(*law, world, nullptr, loading);
}

void find_unread_constants(const language::Object& world, Loading& loading) {
  if (!has_contact(world, loading)) return;
  std::set<int> used = foot_materials_in_use(world, loading);
  used.merge(ground_materials(world, loading));
  const contact::LawDescription* law = chosen_law(world, loading);
  for (const language::Object* material : written(used, loading)) {
    if (material == nullptr) continue;
    if (law != nullptr) check_unread(*law, *material, loading);
    const auto index = static_cast<std::size_t>(loading.materials.at(material));
    loading.experiment.materials[index].meant =
        unread_constants(*material, loading, [](auto) { return false; });
  }
}

}  // namespace hookpoint::simulation
