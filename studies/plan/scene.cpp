#include "studies/plan/scene.h"

#include <fmt/format.h>

#include <algorithm>
#include <utility>

#include "language/names.h"
#include "simulation/engine_interface/identity.h"
#include "simulation/scene/load.h"

namespace hookpoint::studies {
namespace {

using language::Object;

bool is_terrain(const Object& object) { return object.type.starts_with("Terrain."); }

/// Takes Terrains and Materials out of `owner`, and of the Groups in it.
void clear_ground(Object& owner) {
  std::erase_if(owner.children,
                [](const auto& child) { return is_terrain(*child) || child->type == "Material"; });
  for (const auto& child : owner.children)
    if (child->type == "Group") clear_ground(*child);
}

/// Moves what stands at the top of a terrain's file into the world.
void move_ground(Object& terrain, Object& world) {
  for (auto& child : terrain.children) {
    if (child->implicit) continue;
    child->parent = &world;
    world.children.push_back(std::move(child));
  }
}

/// Puts the ground in the place of that of the first World.
void change_ground(Object& ground, Object& root) {
  const auto world =
      std::ranges::find_if(root.children, [](const auto& child) { return child->type == "World"; });
  if (world == root.children.end()) return;
  clear_ground(**world);
  move_ground(ground, **world);
}

}  // namespace

std::unique_ptr<Object> lay_down(language::Library& library, const GroundPlan& ground,
                                 language::Diagnostics& diagnostics) {
  language::EvaluateOptions options;
  options.parameters = ground.parameters;
  auto tree = library.evaluate(ground.file, options, diagnostics);
  if (tree == nullptr) return nullptr;
  if (tree->children_of("Terrain.").empty()) {
    diagnostics.error(tree->position, "the terrain's file holds no Terrain");
    return nullptr;
  }
  if (!tree->plugins.empty()) {
    diagnostics.error(tree->position,
                      "a terrain's file holds a Terrain and Materials alone: its Plugin " +
                          tree->plugins.front() + " is not loaded; name it in the scene");
    return nullptr;
  }
  for (const auto& child : tree->children) {
    if (child->implicit || is_terrain(*child) || child->type == "Material" ||
        child->type == "Group")
      continue;
    diagnostics.error(child->position,
                      "a terrain's file holds a Terrain and Materials alone, no " + child->type);
    return nullptr;
  }
  return tree;
}

std::unique_ptr<Object> lay_down(language::Library& library, const ScenePlan& scene,
                                 language::Diagnostics& diagnostics) {
  language::EvaluateOptions options = scene.options;
  std::unique_ptr<Object> ground;
  if (scene.ground) {
    ground = lay_down(library, *scene.ground, diagnostics);
    if (ground == nullptr) return nullptr;
    options.amend = [&ground](Object& root) { change_ground(*ground, root); };
  }
  return library.evaluate(scene.file, options, diagnostics);
}

std::optional<LoadedScene> load_scene(language::Library& library, const ScenePlan& scene,
                                      language::Diagnostics& diagnostics) {
  auto tree = lay_down(library, scene, diagnostics);
  if (!tree) return std::nullopt;
  auto experiment = simulation::load_experiment(*tree, diagnostics, library.search_path(), {},
                                                simulation::RunOf::study);
  if (!experiment || diagnostics.has_errors()) return std::nullopt;
  simulation::write_chosen_step(*experiment, *tree);
  return LoadedScene{std::move(tree), std::move(*experiment)};
}

std::set<std::string> LoadedScene::sources() const {
  std::set<std::string> files = simulation::files_read(experiment);
  for (std::string& source : language::sources_of(*tree)) files.insert(std::move(source));
  return files;
}

std::string LoadedScene::hash() const { return simulation::experiment_hash(printed(), experiment); }

void ScenePlan::give(const DeclaredParameters& declared, const std::string& parameter,
                     const std::string& value) {
  if (language::contains(declared.scene, parameter)) options.parameters[parameter] = value;
  if (ground && language::contains(declared.ground, parameter))
    ground->parameters[parameter] = value;
}

void ScenePlan::set(const std::string& trail, const std::string& value) {
  options.overrides.push_back({trail, value});
}

void ScenePlan::set_world(const std::string& field, const std::string& value) {
  set(world + "." + field, value);
}

void ScenePlan::set_world(const Composition& words) {
  for (const CompositionWord& word : composition_words)
    if (!(words.*word.member).empty()) set_world(word.field, words.*word.member);
}

std::vector<std::string> parameter_names(language::Library& library,
                                         const std::filesystem::path& file,
                                         language::Diagnostics& diagnostics) {
  std::vector<std::string> names;
  for (const auto& declared : library.parameters(file, diagnostics)) names.push_back(declared.name);
  return names;
}

std::string first_name(const std::string& trail) { return trail.substr(0, trail.find('.')); }

std::vector<language::Override> settings_of_scene(const SceneSettings& settings,
                                                  const std::vector<std::string>& parameters,
                                                  const language::Object& scene,
                                                  const std::string& world) {
  std::vector<language::Override> taken;
  for (const language::Override& setting : settings.trails) {
    const std::string first = first_name(setting.trail);
    const bool has_object = std::ranges::any_of(
        scene.children, [&](const auto& child) { return child->name == first; });
    if (has_object || std::ranges::find(parameters, setting.trail) != parameters.end())
      taken.push_back(setting);
  }
  for (const auto& [field, value] : settings.world) taken.push_back({world + "." + field, value});
  return taken;
}

std::vector<std::string> setting_words(const language::EvaluateOptions& options) {
  std::vector<std::string> words;
  for (const auto& [parameter, value] : options.parameters)
    words.push_back(parameter + "=" + value);
  for (const language::Override& setting : options.overrides)
    words.push_back(setting.trail + "=" + setting.value);
  return words;
}

namespace {

/// The field of that trail from the top; null where there is none. The names of an object and of a
/// field may both hold dots.
const language::Field* field_at(const language::Object& scene, const std::string& trail) {
  for (std::size_t dot = trail.rfind('.'); dot != std::string::npos && dot > 0;
       dot = trail.rfind('.', dot - 1)) {
    language::Diagnostics unreported;
    const auto owner = language::resolve(scene, trail.substr(0, dot), false, unreported);
    if (owner) return owner->object->find(trail.substr(dot + 1));
  }
  return nullptr;
}

bool same_in_both(const language::Field* one, const language::Field* other) {
  if (one == nullptr || other == nullptr) return one == other;
  return one->numbers == other->numbers && one->words == other->words &&
         one->reference.trail == other->reference.trail;
}

}  // namespace

const language::Override* changed_setting(const std::vector<language::Override>& settings,
                                          const language::Object& one,
                                          const language::Object& other) {
  const auto changed = std::ranges::find_if(settings, [&](const language::Override& setting) {
    return !same_in_both(field_at(one, setting.trail), field_at(other, setting.trail));
  });
  return changed == settings.end() ? nullptr : &*changed;
}

std::string decided_already(const language::Override& setting) {
  return fmt::format("the study decides of `{}`: it cannot be set as well", setting.trail);
}

std::optional<std::string> setting_problem(const language::Override& setting,
                                           const std::string& world, const SubjectPlan& subject) {
  for (const auto& [field, member, doc] : composition_words) {
    if (!(subject.*member).empty() && setting.trail == world + "." + field)
      return fmt::format("subject {} says its {} itself: `{}` cannot be set as well",
                         subject.info.name, field, setting.trail);
  }
  for (const Assignment& fix : subject.fixes) {
    if (fix.parameter == setting.trail)
      return fmt::format("subject {} fixes `{}`: it cannot be set as well", subject.info.name,
                         fix.parameter);
  }
  return std::nullopt;
}

}  // namespace hookpoint::studies
