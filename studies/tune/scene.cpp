#include "studies/tune/scene.h"

#include <fmt/format.h>

#include <algorithm>

#include "language/names.h"
#include "simulation/scene/load.h"

namespace hookpoint::studies {
namespace {

using language::Diagnostics;
using language::Object;

/// The Param that every run of a candidate has another value of.
constexpr const char* seed_parameter = "seed";

bool names_it(const std::vector<std::string>& names, const std::string& name) {
  return std::ranges::find(names, name) != names.end();
}

std::vector<std::string> parameter_names(language::Library& library,
                                         const std::filesystem::path& file,
                                         Diagnostics& diagnostics) {
  std::vector<std::string> names;
  for (const auto& declared : library.parameters(file, diagnostics)) names.push_back(declared.name);
  return names;
}

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
    const language::Field* field = object.find("material");
    const Object* material = field == nullptr ? nullptr : field->reference.object;
    if (material != nullptr && std::ranges::find(found, material) == found.end())
      found.push_back(material);
  };
  for (const Object* terrain : world.children_of("Terrain.")) {
    add(*terrain);
    for (const Object* patch : terrain->children_of("Patch")) add(*patch);
  }
  return found;
}

/// Params of these constants that the file declares, with the seed where it takes one.
std::map<std::string, std::string> parameter_values(std::span<const ConstantSetting> constants,
                                                    ConstantPlace place,
                                                    const std::vector<std::string>& declared,
                                                    std::uint64_t seed) {
  std::map<std::string, std::string> values;
  if (names_it(declared, seed_parameter)) values[seed_parameter] = std::to_string(seed);
  for (const ConstantSetting& constant : constants)
    if (constant.place == place) values[constant.name] = constant.text;
  return values;
}

}  // namespace

std::string first_error_of(const Diagnostics& found) {
  for (const language::Diagnostic& diagnostic : found.all())
    if (diagnostic.severity == language::Severity::error) return diagnostic.message;
  return "";
}

TuneScene::TuneScene(language::Library& library, SceneSource source,
                     const language::Position& place, Diagnostics& diagnostics)
    : library_(library), source_(std::move(source)) {
  if (!source_.terrain.empty())
    terrain_parameters_ = parameter_names(library_, source_.terrain, diagnostics);
  scene_parameters_ = parameter_names(library_, source_.scene, diagnostics);
  for (ConstantSetting& settled : source_.settled) {
    const auto found = place_of(settled.name);
    if (!found)
      diagnostics.error(place, fmt::format("no Param of the scene is called `{}`{}", settled.name,
                                           language::did_you_mean(settled.name, names())));
    settled.place = found.value_or(ConstantPlace::scene_parameter);
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
    const auto terrain = lay_down(library_, *row_scene({}, 1).ground, diagnostics);
    if (terrain != nullptr) terrain_values_ = terrain->parameters;
  }
  if (find_material(*own_, place, diagnostics))
    material_fields_ = number_fields(*material_of(*own_).schema);
}

bool TuneScene::find_material(const Object& tree, const language::Position& place,
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

std::optional<ConstantPlace> TuneScene::place_of(const std::string& name) const {
  if (names_it(terrain_parameters_, name)) return ConstantPlace::terrain_parameter;
  if (names_it(scene_parameters_, name)) return ConstantPlace::scene_parameter;
  if (names_it(material_fields_, name)) return ConstantPlace::material_field;
  if (names_it(world_fields_, name)) return ConstantPlace::world_field;
  return std::nullopt;
}

std::vector<std::string> TuneScene::names() const {
  std::vector<std::string> all;
  for (const Names* some :
       {&terrain_parameters_, &scene_parameters_, &material_fields_, &world_fields_})
    for (const std::string& name : *some)
      if (!names_it(all, name)) all.push_back(name);
  return all;
}

std::optional<double> TuneScene::own_value(const ConstantSetting& constant) const {
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
    case ConstantPlace::terrain_parameter:
      return of_parameters(terrain_values_);
    case ConstantPlace::scene_parameter:
      return of_parameters(scene_values_);
    case ConstantPlace::material_field:
      return of_field(material_of(*own_));
    case ConstantPlace::world_field:
      return of_field(*own_->children_of("World").front());
  }
  return std::nullopt;
}

RowScene TuneScene::row_scene(std::span<const ConstantSetting> constants,
                              std::uint64_t seed) const {
  std::vector<ConstantSetting> all(source_.settled);
  all.insert(all.end(), constants.begin(), constants.end());
  RowScene scene{source_.scene, {}};
  if (!source_.terrain.empty())
    scene.ground = {source_.terrain, parameter_values(all, ConstantPlace::terrain_parameter,
                                                      terrain_parameters_, seed)};
  scene.options.parameters =
      parameter_values(all, ConstantPlace::scene_parameter, scene_parameters_, seed);
  for (const ConstantSetting& constant : all) {
    const bool material = constant.place == ConstantPlace::material_field;
    if (material || constant.place == ConstantPlace::world_field)
      scene.options.overrides.push_back(
          {(material ? material_trail_ : world_) + "." + constant.name, constant.text});
  }
  if (!world_.empty()) {
    for (const auto& [field, text] : source_.world)
      scene.options.overrides.push_back({world_ + "." + field, text});
    scene.options.overrides.push_back({world_ + ".seed", std::to_string(seed)});
  }
  return scene;
}

std::unique_ptr<Object> TuneScene::compose(std::span<const ConstantSetting> constants,
                                           std::uint64_t seed, Diagnostics& diagnostics) const {
  return lay_down(library_, row_scene(constants, seed), diagnostics);
}

std::optional<TunedScene> TuneScene::load(std::span<const ConstantSetting> constants,
                                          std::uint64_t seed, Diagnostics& diagnostics) const {
  auto tree = compose(constants, seed, diagnostics);
  if (tree == nullptr) return std::nullopt;
  auto experiment = simulation::load_experiment(*tree, diagnostics, library_.search_path());
  if (!experiment || diagnostics.has_errors()) return std::nullopt;
  simulation::write_chosen_step(*experiment, *tree);
  return TunedScene{std::move(tree), std::move(*experiment)};
}

const language::ClassSchema& TuneScene::world_schema() const {
  return *own_->children_of("World").front()->schema;
}

const Object& TuneScene::material_of(const Object& tree) const {
  const Object& world = *tree.children_of("World").front();
  for (const Object* material : ground_materials(world))
    if (material->name == source_.material) return *material;
  return world;
}

}  // namespace hookpoint::studies
