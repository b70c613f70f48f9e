// Terrain: the ground, of whatever shape; planes (Terrain.Flat, Terrain.Slope). Patch: tiles of
// another material. Heights that are read or computed are terrain/'s.
#include "contact/terrain/terrain.h"

#include <algorithm>

#include "language/tree/fields.h"
#include "simulation/engine_interface/engine.h"
#include "simulation/scene/body.h"
#include "simulation/scene/load.h"
#include "simulation/scene/load_parts.h"
#include "simulation/scene/schema.h"
#include "simulation/scene/terrain/classes.h"

namespace hookpoint::simulation {

using language::append;
using language::Direction;
using language::Fields;
using language::FieldSchema;
using language::list_field;
using language::number_field;
using language::object_field;
using language::orientation_field;
using language::port_only;
using language::vector_field;

namespace {

namespace terrain_field {
constexpr const char *material = "material", *from = "from", *to = "to";
}

const Fields<FlatSpec>& flat_fields() {
  static const Fields<FlatSpec> fields{
      number_field("height", "m", &FlatSpec::height, "z of the ground"),
  };
  return fields;
}

const Fields<SlopeSpec>& slope_fields() {
  static const Fields<SlopeSpec> fields{
      required(not_negative(at_most(
          1.57, number_field("angle", "rad", &SlopeSpec::angle, "of the fall, below 90 deg")))),
      number_field("azimuth", "rad", &SlopeSpec::azimuth, "direction of the fall, from +x about z"),
  };
  return fields;
}

const Fields<TerrainSpec>& moving_fields() {
  static const Fields<TerrainSpec> fields{
      with_port(Direction::both,
                vector_field("velocity", "m/s", &TerrainSpec::velocity,
                             "of its material along the surface, which stays: a belt, world axes; "
                             "under touch = shapes")),
      with_port(Direction::both, vector_field("frame_velocity", "m/s", &TerrainSpec::frame_velocity,
                                              "of the whole ground: a shaker, a lift; world axes")),
      with_port(
          Direction::both,
          vector_field("frame_angular_velocity", "rad/s", &TerrainSpec::frame_angular_velocity,
                       "of the whole ground about what was the world's origin: a tilting "
                       "plate; world axes")),
  };
  return fields;
}

/// Whether a ground that moves is felt; says what to do where it is not. A peer whose ground stands
/// still says so by itself.
void check_motion(const language::Object& object, Loading& loading) {
  const Experiment& experiment = loading.experiment;
  if (!ground_moves(experiment)) return;
  if (experiment.touch != "shapes") {
    loading.error(
        object.position,
        "under touch = points the ground stands still; write touch = shapes in the World");
  }
}

const Fields<contact::TerrainDescription>& plane_fields() {
  using Description = contact::TerrainDescription;
  static const Fields<Description> fields{
      positive(number_field("spacing", "m", &Description::spacing, "edge of a cell of two tiles")),
      not_negative(list_field(
          size_field, "m", 1, 2, language::default_text(Description{}.size_x),
          "extent along x,y (one number: both), centred on the world's origin; 0 is unbounded")),
  };
  return fields;
}

language::ClassSchema plane_class(const char* name, const char* doc, std::vector<FieldSchema> own) {
  append(own, schemas(plane_fields()));
  return terrain_class(name, doc, std::move(own));
}

language::ClassSchema patch_class() {
  language::ClassSchema patch;
  patch.name = "Patch";
  patch.doc =
      "gives the tiles whose centroid is in a rectangle another material; later patches cover "
      "earlier ones";
  patch.fields = {
      required(list_field(terrain_field::from, "m", 2, 2, "", "one corner, world x,y")),
      required(list_field(terrain_field::to, "m", 2, 2, "", "the corner opposite, world x,y")),
      required(object_field(terrain_field::material, "Material", "of the tiles covered")),
  };
  return patch;
}

PatchSpec load_patch(const language::Object& object, Loading& loading) {
  const std::vector<double>& from = object.numbers(terrain_field::from);
  const std::vector<double>& to = object.numbers(terrain_field::to);
  return {std::min(from[0], to[0]), std::min(from[1], to[1]), std::max(from[0], to[0]),
          std::max(from[1], to[1]), material_index(object, loading)};
}

void load_plane_extent(const language::Object& object, contact::TerrainDescription& terrain) {
  store_fields(object, plane_fields(), terrain);
  const std::vector<double>& size = object.numbers(size_field);
  terrain.size_x = size.front();
  terrain.size_y = size.back();
}

void load_surface(const language::Object& object, TerrainSpec& terrain, Loading& loading) {
  if (object.type == "Terrain.Grid") {
    terrain.surface = load_grid(object, terrain, loading);
  } else if (object.type == "Terrain.Rough") {
    terrain.surface = load_rough(object, terrain, loading);
  } else if (object.type == "Terrain.Steps") {
    terrain.surface = load_steps(object, terrain, loading);
  } else {
    load_plane_extent(object, terrain);
    if (object.type == "Terrain.Slope") {
      terrain.surface = load_fields(object, slope_fields());
    } else {
      terrain.surface = load_fields(object, flat_fields());
    }
  }
}

}  // namespace

int material_index(const language::Object& object, Loading& loading) {
  const language::Field* field = object.find(terrain_field::material);
  const language::Object* material = field == nullptr ? nullptr : field->reference.object;
  const auto [entry, is_new] = loading.materials.try_emplace(
      material, static_cast<int>(loading.experiment.materials.size()));
  if (is_new) loading.experiment.materials.push_back(default_material());
  return entry->second;
}

language::ClassSchema terrain_class(const char* name, const char* doc,
                                    std::vector<FieldSchema> own) {
  language::ClassSchema terrain;
  terrain.name = name;
  terrain.doc = doc;
  terrain.naming = language::Naming::required;
  terrain.top_level = true;
  terrain.children = {"Patch"};
  terrain.fields = std::move(own);
  terrain.fields.push_back(object_field(
      terrain_field::material, "Material",
      "of every tile that no Patch covers; if not given, a material with all defaults"));
  append(terrain.fields, schemas(moving_fields()));
  append(terrain.fields,
         {port_only(Direction::output,
                    number_field("work", "J", "",
                                 "of its motion, frame and belt, on bodies since the start, under "
                                 "touch = shapes")),
          port_only(Direction::output,
                    vector_field("position", "m", "", "of its frame's origin, 0 at first")),
          port_only(Direction::output,
                    orientation_field("orientation", "its frame to world axes, w,x,y,z"))});
  append(terrain.fields, surface_contact_ports());
  return terrain;
}

void add_terrain_classes(language::Schema& schema) {
  schema.add(plane_class("Terrain.Flat", "level ground", schemas(flat_fields())));
  schema.add(plane_class(
      "Terrain.Slope",
      "a plane through the world's origin that falls along +x turned by azimuth about z",
      schemas(slope_fields())));
  add_grid_class(schema);
  add_rough_class(schema);
  add_steps_class(schema);
  schema.add(patch_class());
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
  store_fields(object, moving_fields(), terrain);
  loading.experiment.terrain = std::move(terrain);
}

void check_moving_ground(const language::Object& root, Loading& loading) {
  for (const language::Object* world : root.children_of("World"))
    for (const language::Object* object : world->children_of("Terrain."))
      check_motion(*object, loading);
}

const language::Object* material_of_ground(const language::Object& ground) {
  const language::Field* field = ground.find(terrain_field::material);
  return field == nullptr ? nullptr : field->reference.object;
}

}  // namespace hookpoint::simulation
