#include "simulation/scene/load.h"

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <utility>

#include "simulation/analysis/automatic_step.h"
#include "simulation/engine_interface/step_count.h"
#include "simulation/scene/load_parts.h"
#include "simulation/scene/unread_constants.h"

namespace hookpoint::simulation {
namespace {

/// What a module may hold at its top, to be created elsewhere, and where.
constexpr std::array<std::pair<const char*, const char*>, 5> homes{{{"Robot", "World"},
                                                                    {"Terrain.", "World"},
                                                                    {"Obstacle.", "World"},
                                                                    {"Chain", "Robot or a Link"},
                                                                    {"Link", "Chain"}}};

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

/// `deltat = auto`, written or by default.
bool is_automatic(const language::Object& world) {
  return !world.find(deltat_field)->words.empty();
}

void load_signals(const language::Object& root, Loading& loading) {
  const std::size_t errors_before = loading.diagnostics.error_count();
  load_values(root, loading);
  load_points(loading);
  load_components(root, loading);
  if (loading.diagnostics.error_count() == errors_before) load_wires(root, loading);
  if (loading.diagnostics.error_count() == errors_before) check_moving_ground(root, loading);
  load_records(root, loading);
  load_movies(root, loading);
  load_expectations(root, loading);
}

/// So fine that hardly a rate is too high for it [s].
constexpr double finest_step = 1e-6;

/// Chooses the step of an experiment whose robots, ground and materials are loaded. Controllers,
/// wires and rates decide it too, and are themselves checked against it: they are loaded into a
/// copy with a step that they allow. Where they allow none, what is wrong is reported when they are
/// loaded for good.
void choose_deltat(const language::Object& root, Loading& loading) {
  loading.experiment.deltat = largest_automatic_step;
  for (const double step : {largest_automatic_step, finest_step}) {
    language::Diagnostics unreported;
    Loading trial{unreported,
                  loading.search_path,
                  loading.given,
                  loading.experiment,
                  loading.materials,
                  loading.bodies,
                  loading.bases,
                  {},
                  {},
                  {},
                  0,
                  {}};
    trial.experiment.deltat = step;
    load_signals(root, trial);
    if (unreported.has_errors()) continue;
    const ChosenStep chosen = choose_step(trial.experiment);
    loading.experiment.deltat = chosen.step;
    loading.experiment.chosen_from = chosen.bound;
    return;
  }
}

/// A step that was chosen may make a run long: of stiff ground under a light body.
void warn_of_many_steps(const language::Object& world, Loading& loading) {
  constexpr double many = 1e7;
  const Experiment& experiment = loading.experiment;
  const double steps = experiment.duration / experiment.deltat;
  if (!(steps >= many)) return;
  loading.diagnostics.warning(
      world.position,
      fmt::format("the chosen step is {:.2g} s, so that the run takes {:.1e} steps: the ground is "
                  "stiff for the lightest body that touches it; lower its normal_stiffness and "
                  "tangential_stiffness, or choose `deltat` or an integrator that bears more",
                  experiment.deltat, steps));
}

}  // namespace

std::optional<Experiment> load_experiment(const language::Object& root,
                                          language::Diagnostics& diagnostics,
                                          const std::vector<std::filesystem::path>& search_path,
                                          const std::vector<FileSpec>& given, RunOf run) {
  Loading loading{diagnostics, search_path, given, {}, {}, {}, {}, {}, {}, {}, 0, {}};
  const std::size_t errors_before = diagnostics.error_count();
  const language::Object* world = find_world(root, loading);
  if (world == nullptr) return std::nullopt;
  check_strays(root, loading);
  load_world(*world, loading);
  loading.serves_study = run == RunOf::study && (set_from_outside(*world, "contact") ||
                                                 set_from_outside(*world, "engine"));
  load_materials(root, loading);
  load_terrain(*world, loading);
  warn_of_unstated_constants(*world, loading);
  find_unread_constants(*world, loading);
  load_robots(*world, loading);
  load_obstacles(*world, loading);
  if (diagnostics.error_count() == errors_before) load_couplings(*world, loading);
  if (diagnostics.error_count() == errors_before) load_loops(*world, loading);
  warn_of_overlaps(loading);
  load_forces(*world, loading);
  check_combinations(*world, loading);
  // A pose on the ground means something only for robots and ground that are right.
  if (diagnostics.error_count() == errors_before) {
    const std::vector<bool> laid = lay_on_terrain(loading);
    if (diagnostics.error_count() == errors_before)
      complete_mujoco_materials(is_automatic(*world), loading);
    settle_on_terrain(laid, loading);
    if (diagnostics.error_count() == errors_before) warn_of_start_depths(loading);
  }
  if (diagnostics.error_count() == errors_before && is_automatic(*world))
    choose_deltat(root, loading);
  if (diagnostics.error_count() == errors_before && loading.experiment.chosen_from)
    warn_of_many_steps(*world, loading);
  if (diagnostics.error_count() == errors_before)
    check_duration(place_of(*world, duration_field), loading.experiment.duration,
                   loading.experiment.deltat, diagnostics);
  if (diagnostics.error_count() == errors_before) load_signals(root, loading);
  if (diagnostics.error_count() != errors_before) return std::nullopt;
  return std::move(loading.experiment);
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
      const language::FieldSchema* schema = child->schema->find(deltat_field);
      auto at = std::ranges::lower_bound(child->fields, schema, {}, &language::Field::schema);
      if (at == child->fields.end() || at->schema != schema) {
        at = child->fields.insert(at, language::Field());
        at->schema = schema;
        at->given = true;
        at->position = child->position;
      }
      at->words.clear();
      at->numbers = {experiment.deltat};
    }
  };
  write(write, root);
}

}  // namespace hookpoint::simulation
