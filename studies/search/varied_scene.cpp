#include "studies/search/varied_scene.h"

#include <fmt/format.h>

#include <algorithm>

#include "language/names.h"
#include "simulation/scene/load.h"
#include "studies/blocks/fix.h"

namespace hookpoint::studies {
namespace {

using language::Diagnostics;
using language::Object;

/// The Param that every run of a candidate has another value of.
constexpr const char* seed_parameter = "seed";

/// The names of the class's numbers that a file may assign.
std::vector<std::string> number_fields(const language::ClassSchema& schema) {
  std::vector<std::string> names;
  for (const language::FieldSchema& field : schema.fields)
    if (field.type == language::FieldType::number && field.setting) names.push_back(field.name);
  return names;
}

/// The Materials under the ground of a world, each once.
std::vector<const Object*> ground_materials(const Object& world) {
  std::vector<const Object*> found;
  const auto add = [&](const Object& object) {
    const Object* material = simulation::material_of_ground(object);
    if (material != nullptr && std::ranges::find(found, material) == found.end())
      found.push_back(material);
  };
  for (const Object* terrain : world.children_of("Terrain.")) {
    add(*terrain);
    for (const Object* patch : terrain->children_of("Patch")) add(*patch);
  }
  return found;
}

}  // namespace

std::vector<ConstantSetting> fixed_constants(const Object& owner) {
  std::vector<ConstantSetting> settings;
  for (const Object* fix : owner.children_of("Fix"))
    settings.push_back({ConstantPlace::parameter, fix->name, fixed_text(*fix)});
  return settings;
}

std::filesystem::path file_beside(const Object& owner, const language::Placed<std::string>& name,
                                  const std::string& file, const language::Library& library,
                                  Diagnostics& diagnostics) {
  if (!name) return {};
  const std::filesystem::path found = library.find(*name, file);
  if (found.empty())
    diagnostics.error(name.position(), fmt::format("no file \"{}\" beside the {} or in configs/",
                                                   *name, owner.type));
  return found;
}

SceneSource scene_source(const Object& owner, const VariedSceneBlock& block, const Object* subject,
                         const Composition& words, const std::string& file,
                         const language::Library& library, Diagnostics& diagnostics) {
  SceneSource source;
  source.scene = file_beside(owner, block.scene, file, library, diagnostics);
  source.terrain = file_beside(owner, block.terrain, file, library, diagnostics);
  source.material = block.material;
  source.settled = fixed_constants(owner);
  if (subject != nullptr)
    for (ConstantSetting& setting : fixed_constants(*subject))
      source.settled.push_back(std::move(setting));
  source.words = words;
  return source;
}

VariedScene::VariedScene(language::Library& library, SceneSource source,
                         const language::Position& place, Diagnostics& diagnostics)
    : library_(library), source_(std::move(source)) {
  if (!source_.terrain.empty())
    parameters_.ground = parameter_names(library_, source_.terrain, diagnostics);
  parameters_.scene = parameter_names(library_, source_.scene, diagnostics);
  for (ConstantSetting& settled : source_.settled) {
    const auto found = place_of(settled.name);
    if (!found)
      diagnostics.error(place, fmt::format("no Param of the scene is called `{}`{}", settled.name,
                                           language::did_you_mean(settled.name, names())));
    settled.place = found.value_or(ConstantPlace::parameter);
  }
  if (diagnostics.has_errors()) return;
  own_ = compose({}, 1, diagnostics);
  if (own_ == nullptr) return;
  const std::vector<const Object*> worlds = own_->children_of("World");
  if (worlds.empty()) {
    diagnostics.error(place, "the scene has no World");
    return;
  }
  world_ = worlds.front()->trail();
  world_fields_ = number_fields(*worlds.front()->schema);
  scene_values_ = own_->parameters;
  if (!source_.terrain.empty()) {
    const auto terrain = lay_down(library_, *under({}, 1).ground, diagnostics);
    if (terrain != nullptr) terrain_values_ = terrain->parameters;
  }
  if (find_material(*own_, place, diagnostics))
    material_fields_ = number_fields(*material_of(*own_).schema);
}

bool VariedScene::find_material(const Object& tree, const language::Position& place,
                                Diagnostics& diagnostics) {
  const Object& world = *tree.children_of("World").front();
  const std::vector<const Object*> under = ground_materials(world);
  std::vector<std::string> names;
  for (const Object* material : under) names.push_back(material->name);
  if (source_.material.empty() && under.size() == 1) source_.material = names.front();
  const auto found = std::ranges::find(names, source_.material);
  if (found == names.end()) {
    diagnostics.error(place,
                      names.empty() ? "the scene's ground has no Material to tune"
                      : source_.material.empty()
                          ? "the ground has several Materials: say `material = ` and one of " +
                                language::join(names, ", ")
                          : fmt::format("the ground has no Material `{}`{}", source_.material,
                                        language::did_you_mean(source_.material, names)));
    return false;
  }
  material_trail_ = under[static_cast<std::size_t>(found - names.begin())]->trail();
  return true;
}

std::optional<ConstantPlace> VariedScene::place_of(const std::string& name) const {
  for (const Names* declared : {&parameters_.ground, &parameters_.scene})
    if (language::contains(*declared, name)) return ConstantPlace::parameter;
  if (language::contains(material_fields_, name)) return ConstantPlace::material_field;
  if (language::contains(world_fields_, name)) return ConstantPlace::world_field;
  return std::nullopt;
}

std::vector<std::string> VariedScene::names() const {
  std::vector<std::string> all;
  for (const Names* some :
       {&parameters_.ground, &parameters_.scene, &material_fields_, &world_fields_})
    for (const std::string& name : *some)
      if (!language::contains(all, name)) all.push_back(name);
  return all;
}

std::optional<double> VariedScene::own_value(const ConstantSetting& constant) const {
  const auto of_parameters = [&](const auto& values) -> std::optional<double> {
    const auto found = std::ranges::find(values, constant.name, &language::ParameterValue::name);
    return found == values.end() ? std::nullopt : std::optional(found->value);
  };
  const auto of_field = [&](const Object& object) -> std::optional<double> {
    const language::Field* field = object.find(constant.name);
    return field == nullptr || field->numbers.empty() ? std::nullopt
                                                      : std::optional(field->numbers.front());
  };
  switch (constant.place) {
    case ConstantPlace::parameter:
      return language::contains(parameters_.ground, constant.name) ? of_parameters(terrain_values_)
                                                                   : of_parameters(scene_values_);
    case ConstantPlace::material_field:
      return of_field(material_of(*own_));
    case ConstantPlace::world_field:
      return of_field(*own_->children_of("World").front());
  }
  return std::nullopt;
}

std::string VariedScene::trail_of(const std::string& name, ConstantPlace place) const {
  if (place == ConstantPlace::material_field) return material_trail_ + "." + name;
  return place == ConstantPlace::world_field ? world_ + "." + name : name;
}

ScenePlan VariedScene::under(std::span<const ConstantSetting> constants, std::uint64_t seed) const {
  std::vector<ConstantSetting> all(source_.settled);
  all.insert(all.end(), constants.begin(), constants.end());
  ScenePlan scene{source_.scene, {}, world_};
  if (!source_.terrain.empty()) scene.ground = {source_.terrain, {}};
  scene.give(parameters_, seed_parameter, std::to_string(seed));
  for (const ConstantSetting& constant : all) {
    if (constant.place == ConstantPlace::parameter)
      scene.give(parameters_, constant.name, constant.text);
    if (constant.place == ConstantPlace::material_field)
      scene.set(trail_of(constant.name, constant.place), constant.text);
    if (constant.place == ConstantPlace::world_field) scene.set_world(constant.name, constant.text);
  }
  if (!world_.empty()) {
    scene.set_world(source_.words);
    scene.set_world("seed", std::to_string(seed));
  }
  return scene;
}

std::unique_ptr<Object> VariedScene::compose(std::span<const ConstantSetting> constants,
                                             std::uint64_t seed, Diagnostics& diagnostics) const {
  return lay_down(library_, under(constants, seed), diagnostics);
}

std::optional<LoadedScene> VariedScene::load(std::span<const ConstantSetting> constants,
                                             std::uint64_t seed, Diagnostics& diagnostics) const {
  return load_scene(library_, under(constants, seed), diagnostics);
}

const language::ClassSchema& VariedScene::world_schema() const {
  return *own_->children_of("World").front()->schema;
}

const Object& VariedScene::material_of(const Object& tree) const {
  const Object& world = *tree.children_of("World").front();
  for (const Object* material : ground_materials(world))
    if (material->name == source_.material) return *material;
  return world;
}

}  // namespace hookpoint::studies
