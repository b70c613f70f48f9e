#include <fmt/format.h>

#include "contact/ascii_grid.h"
#include "contact/terrain.h"
#include "simulation/load_parts.h"
#include "simulation/material_fields.h"

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

GridSpec load_grid(const language::Object& object, TerrainSpec& terrain, Loading& loading) {
  const language::Position& place = place_of(object, "file");
  const std::string& name = object.word("file");
  const std::filesystem::path path = find_file(name, place, loading);
  if (path.empty()) return {};
  const contact::AsciiGridResult result = contact::read_ascii_grid(path);
  if (!result.grid) {
    loading.error(
        place, fmt::format("\"{}\" cannot be read as a grid of heights: {}", name, result.message));
    return {};
  }
  const contact::AsciiGrid& grid = *result.grid;
  const language::Field* spacing = object.find("spacing");
  terrain.spacing = spacing != nullptr ? spacing->numbers[0] : grid.spacing.value_or(1.);
  GridSpec surface{grid.columns, grid.rows, grid.heights, 0., 0.};
  surface.origin_x = grid.origin_x.value_or(-0.5 * (grid.columns - 1) * terrain.spacing);
  surface.origin_y = grid.origin_y.value_or(-0.5 * (grid.rows - 1) * terrain.spacing);
  if (object.given("origin")) {
    surface.origin_x = object.numbers("origin")[0];
    surface.origin_y = object.numbers("origin")[1];
  }
  for (double& height : surface.heights) height += object.number("height");
  return surface;
}

PatchSpec load_patch(const language::Object& object, Loading& loading) {
  const std::vector<double>& from = object.numbers("from");
  const std::vector<double>& to = object.numbers("to");
  return {std::min(from[0], to[0]), std::min(from[1], to[1]), std::max(from[0], to[0]),
          std::max(from[1], to[1]), material_index(object, loading)};
}

void load_plane_extent(const language::Object& object, TerrainSpec& terrain) {
  terrain.spacing = object.number("spacing");
  const std::vector<double>& size = object.numbers("size");
  terrain.size_x = size.front();
  terrain.size_y = size.back();
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
  if (object.type == "Terrain.Grid") {
    terrain.surface = load_grid(object, terrain, loading);
  } else {
    load_plane_extent(object, terrain);
    if (object.type == "Terrain.Slope") {
      terrain.surface = SlopeSpec{object.number("angle"), object.number("azimuth")};
    } else {
      terrain.surface = FlatSpec{object.number("height")};
    }
  }
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
