#include <fmt/format.h>

#include "contact/terrain/terrain.h"
#include "simulation/material_fields.h"
#include "simulation/scene/load_parts.h"

namespace hookpoint::simulation {
namespace {

/// Each coefficient of friction stands in for the other when only one is given.
void load_friction(const language::Object& object, contact::MaterialConstants<double>& constants,
                   Loading& loading) {
  const bool has_static = object.given("static_friction");
  const bool has_kinetic = object.given("kinetic_friction");
  if (has_static) constants.static_friction = object.number("static_friction");
  if (has_kinetic) constants.kinetic_friction = object.number("kinetic_friction");
  if (has_static && !has_kinetic) constants.kinetic_friction = constants.static_friction;
  if (has_kinetic && !has_static) constants.static_friction = constants.kinetic_friction;
  if (constants.kinetic_friction > constants.static_friction) {
    loading.error(
        place_of(object, "kinetic_friction"),
        fmt::format(
            "kinetic_friction {:g} is above static_friction {:g}: sliding would hold better than "
            "sticking; lower it or raise static_friction",
            constants.kinetic_friction, constants.static_friction));
  }
}

/// The index of the Material that `field` names; the default material, appended when first needed,
/// if it names none.
int material_index(const language::Object& object, Loading& loading) {
  const language::Field* field = object.find("material");
  const language::Object* material = field == nullptr ? nullptr : field->reference.object;
  const auto [entry, is_new] = loading.materials.try_emplace(
      material, static_cast<int>(loading.experiment.materials.size()));
  if (is_new) loading.experiment.materials.push_back({"default", {}});
  return entry->second;
}

PatchSpec load_patch(const language::Object& object, Loading& loading) {
  const std::vector<double>& from = object.numbers("from");
  const std::vector<double>& to = object.numbers("to");
  return {std::min(from[0], to[0]), std::min(from[1], to[1]), std::max(from[0], to[0]),
          std::max(from[1], to[1]), material_index(object, loading)};
}

}  // namespace

void load_materials(const language::Object& root, Loading& loading) {
  for (const language::Object* object : collect_all(root, "Material")) {
    MaterialSpec material{object->name, {}};
    for (const MaterialField& field : material_fields()) {
      if (const language::Field* value = object->find(field.name)) {
        material.constants.*field.member = value->numbers[0];
      }
    }
    load_friction(*object, material.constants, loading);
    loading.materials.emplace(object, static_cast<int>(loading.experiment.materials.size()));
    loading.experiment.materials.push_back(std::move(material));
  }
}

void load_terrain(const language::Object& world, Loading& loading) {
  const std::vector<const language::Object*> terrains = world.children_of("Terrain.");
  if (terrains.empty()) return;
  for (std::size_t i = 1; i < terrains.size(); ++i) {
    loading.error(terrains[i]->position, "a second Terrain; a World has at most one ground");
    loading.diagnostics.note(terrains[0]->position, "the first is here");
  }
  const language::Object& object = *terrains[0];
  TerrainSpec terrain;
  terrain.name = object.name;
  const std::size_t errors_before = loading.diagnostics.error_count();
  load_surface(object, terrain, loading);
  terrain.material = material_index(object, loading);
  for (const language::Object* patch : object.children_of("Patch")) {
    terrain.patches.push_back(load_patch(*patch, loading));
  }
  const std::string problem = contact::Terrain::problem(terrain);
  if (loading.diagnostics.error_count() != errors_before) return;
  if (!problem.empty()) return loading.error(object.position, problem);
  loading.experiment.terrain = std::move(terrain);
}

}  // namespace hookpoint::simulation
