// A Study block as a plan: every run there will be, checked, before the first one starts.
#pragma once

#include <cstdint>
#include <filesystem>
#include <memory>
#include <optional>
#include <set>
#include <stdexcept>
#include <string>
#include <utility>
#include <vector>

#include "language/document/document.h"
#include "output/files/result_folder.h"
#include "simulation/analysis/matched_ground.h"
#include "simulation/experiment/experiment.h"
#include "studies/blocks/study_parts.h"
#include "studies/measure/engine_table.h"
#include "studies/measure/metric.h"
#include "studies/measurements/trace_plan.h"
#include "studies/metrics/user_metric.h"
#include "studies/plan/scene.h"
#include "studies/results/assignment.h"
#include "studies/results/result.h"

namespace hookpoint::studies {

struct PlanOptions {
  bool quick = false;
  std::vector<std::string> only;  ///< names of subjects; empty for all
  SceneSettings settings{};
  int jobs = 1;  ///< threads that load scenes
};

/// User-defined metric evaluated for one run.
struct RowForm {
  std::optional<double> predicted = {};  ///< in the metric's unit
  std::string no_form = {};              ///< why there is none
  double allowed = 0.;                   ///< by the scene's own Truth: greatest difference from it
  std::string missing = {};              ///< why the run cannot have the metric; "": it can
};

struct RowPlan {
  std::vector<int> values;  ///< one index a sweep
  int subject = 0;
  /// Its scene but for the swept values, shared by all rows of the subject.
  std::shared_ptr<const ScenePlan> scene;
  double deltat = 0., duration = 0.;  ///< [s]
  std::string engine;                 ///< that runs it
  std::string hash;                   ///< of its experiment and the files that this reads
                                      ///< (simulation/engine_interface/identity.h)
  /// Its engine cannot run it: the scene is kept as ours would run it.
  bool under_ours = false;
  int composition = 0;  ///< index into StudyPlan::compositions
  std::string
      refusal;  ///< why the row's engine cannot run the scene, which others can; "" if it can
  std::vector<RowForm> forms = {};  ///< one a StudyPlan::user_metrics
  /// Where the study has `match`: the constants chosen for its law, which its scene gets.
  std::vector<simulation::MatchedMaterial> matched = {};
};

/// A row's inputs are not what they were when it was planned. The message says what to do.
struct ChangedInput : std::runtime_error {
  using std::runtime_error::runtime_error;
};

struct StudyPlan : StudyParts {
  std::vector<std::string> only;          ///< subjects that run, where --only names some
  std::vector<SubjectInfo> compositions;  ///< engine, law, integrator, settings of rows
  std::vector<RowPlan> rows;              ///< sweeps outermost first, subjects innermost
  std::string printed;                    ///< the study as a file
  std::string scene_printed;              ///< the scene of the first row; "" of a Wall
  /// Of all that the study says, its scenes, and every file that they read, wherever these lie; not
  /// of the program and its engines.
  std::string hash;
  std::vector<output::InputFile> inputs;  ///< files that the study was made from and that it reads

  std::vector<std::string> settable;  ///< Params and objects at the top of its scenes
  std::set<std::uint64_t> seeds;      ///< of its rows
  bool may_end = false;               ///< its runs may end before their duration (Measurement)

  /// Of runs whose step is above the largest stable one: "lugre: deltat 0.01 s is above ...".
  std::vector<std::string> warnings;

  /// Number of rows where no subject has conditions: all values under all subjects. It may be more
  /// than any integer.
  double most_rows() const;
  bool covers(const std::vector<Condition>& conditions, const RowPlan& row) const;
  /// Whether the row records the curve over time that the plot draws.
  bool records(const PlotPlan& plot, const RowPlan& row) const;
  /// Where its results go unless the user says otherwise: runs/<name>-<hash>.
  std::filesystem::path folder() const;
  /// What a row is called: "creep (dts_hookpoint, slope = 5 deg)".
  std::string name_of(const RowPlan& row) const;
  /// What a row's experiment is made of.
  ScenePlan scene_of(const RowPlan& row) const;
  /// The word of a World's field that the row's subject or a Sweep says; "": the scene's own.
  std::string world_word(const RowPlan& row, const std::string& field) const;
  /// How long the row runs with steps of `deltat`, all in seconds: as long as the study says, or up
  /// to the first step that its case's last sample is not after.
  double duration_of(const RowPlan& row, double deltat) const;
  /// What was measured in the row's case, of a Trace that there is.
  std::shared_ptr<const TracePlan> measured_in(const RowPlan& row, const std::string& trace) const;
  /// Where the study has what a diagnostic of the row's scene is about: what it sets in the scene
  /// has a place there. `world`: trail of the scene's World. Other positions stay as they are.
  language::Position place_in_study(const language::Position& position, const RowPlan& row,
                                    const std::string& world) const;
  /// Whether the field is another from row to row of one subject.
  bool varies(const std::string& world_field) const;
  /// The same as `--set` takes it: "slope=5 deg", "world.engine=ode". Without the row's ground.
  std::vector<std::string> settings_of(const RowPlan& row) const;
  /// A row's experiment, as it is run; of one that is refused, as it would be under our engine.
  /// Thread-safe. Throws ChangedInput.
  simulation::Experiment experiment_of(const RowPlan& row) const;
  /// Whether a metric of this scope is measured.
  bool measures(MetricScope scope) const;
  /// The rows in groups that differ at most in the value of `sweep`, in its order; indices. Of no
  /// sweep, -1, each row alone.
  std::vector<std::vector<std::size_t>> groups_along(int sweep) const;
};

/// runs/<name>-<the hash's first twelve digits>.
std::filesystem::path folder_of(const std::string& name, const std::string& hash);

/// The plan of `study` (an object of `root`, evaluated from `file`). Nothing when `diagnostics` got
/// an error: a misspelt name, a unit that does not fit, a value outside the scene's range, a law
/// that its integrator cannot advance. Every row's scene is evaluated and loaded here, once, and
/// again when it runs: `library` outlives the plan.
std::optional<StudyPlan> make_plan(const language::Object& root, const language::Object& study,
                                   const std::string& file, language::Library& library,
                                   const EngineTable& engines, const PlanOptions& options,
                                   language::Diagnostics& diagnostics);

}  // namespace hookpoint::studies
