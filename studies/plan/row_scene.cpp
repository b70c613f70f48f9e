#include "studies/plan/row_scene.h"

#include <algorithm>
#include <utility>

#include "simulation/identity.h"
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

std::unique_ptr<Object> lay_down(language::Library& library, const RowGround& ground,
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

std::unique_ptr<Object> lay_down(language::Library& library, const RowScene& scene,
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

std::optional<LoadedScene> load_scene(language::Library& library, const RowScene& scene,
                                      language::Diagnostics& diagnostics) {
  auto tree = lay_down(library, scene, diagnostics);
  if (!tree) return std::nullopt;
  auto experiment = simulation::load_experiment(*tree, diagnostics, library.search_path());
  if (!experiment || diagnostics.has_errors()) return std::nullopt;
  simulation::write_chosen_step(*experiment, *tree);
  LoadedScene loaded{std::move(*experiment), language::print(*tree), {}};
  loaded.sources = simulation::files_read(loaded.experiment);
  for (std::string& source : language::sources_of(*tree)) loaded.sources.insert(std::move(source));
  loaded.tree = std::move(tree);
  return loaded;
}

}  // namespace hookpoint::studies
