#include "simulation/scene/load.h"

#include <fmt/format.h>

#include <array>
#include <utility>

#include "simulation/analysis/automatic_step.h"
#include "simulation/scene/load_parts.h"
#include "simulation/scene/unread_constants.h"

namespace hookpoint::simulation {
namespace {

/// What a module may hold at its top, to be created elsewhere, and where.
constexpr std::array<std::pair<const char*, const char*>, 4> homes{
    {{"Robot", "World"}, {"Terrain.", "World"}, {"Chain", "Robot or a Link"}, {"Link", "Chain"}}};

/// How the Robot or the ground of a file without a World is run: by a file that includes it.
std::string how_to_run(const language::Object& module) {
  const std::filesystem::path path = module.position.file->path;
  const bool robot = module.type == "Robot";
  const bool foreign = robot && path.extension() != ".hook";
  return fmt::format(
      "there is no World in this file to run its {} in: write a file that includes it, such as "
      "World w {{ {}Include \"{}\"{}; }}",
      module.type, robot ? "Terrain.Flat ground { } " : "", path.filename().string(),
      foreign ? " (rest_on = ground)" : "");
}

/// The one World, or null after saying why there is none.
const language::Object* find_world(const language::Object& root, Loading& loading) {
  const std::vector<const language::Object*> worlds = root.children_of("World");
  if (worlds.empty()) {
    std::string problem = "there is no World in this file; a run needs one: World NAME { ... }";
    for (const char* type : {"Terrain.", "Robot"}) {
      const std::vector<const language::Object*> modules = root.children_of(type);
      if (!modules.empty() && modules.front()->position.file != nullptr)
        problem = how_to_run(*modules.front());
    }
    loading.error(root.position, problem);
    return nullptr;
  }
  for (std::size_t i = 1; i < worlds.size(); ++i) {
    loading.error(worlds[i]->position, "a second World; a file to run holds exactly one");
    loading.diagnostics.note(worlds[0]->position, "the first is here");
  }
  return worlds[0];
}

/// Modules may hold these at their top, to be laid down in a World; in a file to run they would be
/// left out.
void check_strays(const language::Object& root, Loading& loading) {
  for (const auto& [type, home] : homes) {
    for (const language::Object* stray : root.children_of(type)) {
      loading.error(stray->position,
                    fmt::format("{} stands at the top of the file to run; move it into the {}",
                                stray->type, home));
    }
  }
}

/// `deltat = auto`.
bool is_automatic(const language::Object& world) {
  return !world.find(deltat_field)->words.empty();
}

void load_signals(const language::Object& root, Loading& loading) {
  const std::size_t errors_before = loading.diagnostics.error_count();
  load_values(root, loading);
  load_points(loading);
  load_components(root, loading);
  if (loading.diagnostics.error_count() == errors_before) load_wires(root, loading);
  load_records(root, loading);
  load_movies(root, loading);
  load_expectations(root, loading);
}

/// A load with `deltat` [s] where the World says auto.
std::optional<Experiment> load_with_step(const language::Object& root,
                                         language::Diagnostics& diagnostics,
                                         const std::vector<std::filesystem::path>& search_path,
                                         const std::vector<FileSpec>& given,
                                         const ChosenStep& chosen) {
  Loading loading{diagnostics, search_path, given, {}, {}, {}, {}, {}, {}, {}};
  const std::size_t errors_before = diagnostics.error_count();
  const language::Object* world = find_world(root, loading);
  if (world == nullptr) return std::nullopt;
  check_strays(root, loading);
  if (is_automatic(*world)) loading.experiment.deltat = chosen.step;
  if (chosen.bound > 0.) loading.experiment.chosen_from = chosen.bound;
  load_world(*world, loading);
  load_materials(root, loading);
  load_terrain(*world, loading);
  warn_of_unstated_constants(*world, loading);
  warn_of_unread_constants(*world, loading);
  load_robots(*world, loading);
  load_forces(*world, loading);
  check_combinations(*world, loading);
  // A pose on the ground means something only for robots and ground that are right.
  if (diagnostics.error_count() == errors_before) place_on_terrain(loading);
  if (diagnostics.error_count() == errors_before) load_signals(root, loading);
  if (diagnostics.error_count() != errors_before) return std::nullopt;
  return std::move(loading.experiment);
}

/// So fine that hardly a rate is too high for it [s].
constexpr double finest_step = 1e-6;

}  // namespace

std::optional<Experiment> load_experiment(const language::Object& root,
                                          language::Diagnostics& diagnostics,
                                          const std::vector<std::filesystem::path>& search_path,
                                          const std::vector<FileSpec>& given) {
  const auto worlds = root.children_of("World");
  ChosenStep chosen{finest_step, 0., ""};
  if (!worlds.empty() && is_automatic(*worlds[0])) {
    language::Diagnostics untold;
    const auto experiment = load_with_step(root, untold, search_path, given, chosen);
    // What is wrong otherwise is told below.
    if (experiment) chosen = choose_step(*experiment);
    if (!chosen.problem.empty()) {
      diagnostics.error(place_of(*worlds[0], deltat_field), "deltat = auto: " + chosen.problem);
      return std::nullopt;
    }
  }
  return load_with_step(root, diagnostics, search_path, given, chosen);
}

void write_chosen_step(const Experiment& experiment, language::Object& root) {
  if (!experiment.chosen_from) return;
  const auto worlds = root.children_of("World");
  const auto write = [&](auto& self, language::Object& parent) -> void {
    for (const auto& child : parent.children) {
      if (child.get() != worlds[0]) {
        self(self, *child);
        continue;
      }
      for (language::Field& given : child->fields) {
        if (given.schema->name != deltat_field) continue;
        given.words.clear();
        given.numbers = {experiment.deltat};
        given.dimension = language::Dimension{.time = 1};
      }
    }
  };
  write(write, root);
}

}  // namespace hookpoint::simulation
