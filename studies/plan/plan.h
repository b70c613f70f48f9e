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

#include "language/document.h"
#include "output/result_folder.h"
#include "simulation/analysis/matched_ground.h"
#include "simulation/experiment.h"
#include "studies/assignment.h"
#include "studies/engine_table.h"
#include "studies/measurements/trace_plan.h"
#include "studies/metric.h"
#include "studies/metrics/user_metric.h"
#include "studies/plan/row_scene.h"
#include "studies/result.h"

namespace hookpoint::studies {

/// What is set from outside in every scene that has it.
struct SceneSettings {
  std::vector<language::Override> trails;
  std::vector<std::pair<std::string, std::string>> world;  ///< fields of its World, and values
};

struct PlanOptions {
  bool quick = false;
  std::vector<std::string> only;  ///< names of subjects; empty for all
  SceneSettings settings{};
  int jobs = 1;  ///< threads that load scenes
};

/// An `Only` block: some values of a swept Param.
struct Condition {
  int sweep = 0;
  /// SI; none: any within the bounds. Empty where --quick leaves out all that it names.
  std::optional<std::vector<double>> values;
  std::optional<double> from, to;  ///< SI
  bool holds(double value) const;
};

/// What a Sweep sets: a Param, a field of the World, or the ground.
/// `cases`: the Params that a Cases block's table has a column of.
/// `seeds`: the seed of the World's random streams, and a Param `seed` of scene and ground.
enum class SweepRole { parameter, world_field, ground, cases, seeds };

/// A terrain's file, in the place of the scene's ground.
struct SweptGround {
  std::filesystem::path file;
  std::vector<std::string> parameters;  ///< Params that it declares
};

struct SweepPlan {
  SweepColumn column;
  std::vector<double> si;          ///< the same values in SI; of words 0, 1, 2 ...
  std::vector<std::string> texts;  ///< as the language writes them: "5 deg", "clay"
  /// All values that the file gives, of which --quick leaves some out: SI or, of words, 0, 1, 2
  /// ...; and as the language writes them.
  std::vector<double> declared;
  std::vector<std::string> declared_texts;
  std::vector<std::string> declared_words;  ///< where it has words
  SweepRole role = SweepRole::parameter;
  std::vector<language::Position> places;         ///< where each value is written
  std::vector<SweptGround> grounds;               ///< one a value of a ground
  std::vector<std::vector<Assignment>> settings;  ///< one list a case
  /// Of cases of which each lasts up to its last sample: one a case [s]; else empty.
  std::vector<double> durations;

  /// "4 deg, 12 deg": all declared values, or of many those nearest to `value` (SI).
  std::string values_near(std::optional<double> value) const;
  /// Whether the table of cases sets the Param.
  bool assigns(const std::string& parameter) const;
};

/// A Trace of the study's Cases.
struct MeasuredCurves {
  std::string name;
  std::vector<std::string> ports;  ///< trails as the study writes them, one a part
  std::vector<std::shared_ptr<const TracePlan>> cases;  ///< weights are 1
};

struct SubjectPlan {
  SubjectInfo info;
  std::string engine, contact, integrator,
      settings;  ///< as the file says; "" leaves the scene's own
  std::vector<Assignment> fixes;
  std::vector<Condition> only;
};

struct TruthPlan {
  std::size_t metric = 0;  ///< index into StudyPlan::metrics
  bool predicted = false;
  std::optional<double> value, above, below;
  double tolerance = 0., within = 0.;
  int same_over = -1;         ///< index of a sweep
  bool of_scene = false;      ///< an Expect's: each run says what is allowed
  std::vector<int> subjects;  ///< empty: all
  std::vector<Condition> only;
  bool may_be_empty = false;
  std::string name, words;
};

struct PlotPlan {
  PlotSpec spec;
  const SignalDefinition* signal = nullptr;  ///< over time
  std::vector<Condition> only;
};

/// What the user's own definition says of a metric of one run.
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
  std::shared_ptr<const RowScene> scene;
  double deltat = 0., duration = 0.;  ///< [s]
  std::string engine;                 ///< that runs it
  std::string hash;                   ///< of its experiment and the files that this reads
                                      ///< (simulation/identity.h)
  /// Its engine cannot run it: the scene is kept as ours would run it.
  bool under_ours = false;
  int composition = 0;  ///< index into StudyPlan::compositions
  std::string
      refusal;  ///< why the row's engine cannot run the scene, which others can; "" if it can
  std::vector<RowForm> forms = {};  ///< one a StudyPlan::user_metrics
  /// Where the study has `match`: the constants chosen for its law, which its scene gets.
  std::vector<simulation::MatchedMaterial> matched = {};
};

/// The unit in which a study has a metric. A run has one of the user's own in this unit already.
struct ShownUnit {
  std::string text;   ///< "mm/s"
  double scale = 1.;  ///< of a run's value by it
};

/// A row's inputs are not what they were when it was planned. The message says what to do.
struct ChangedInput : std::runtime_error {
  using std::runtime_error::runtime_error;
};

struct StudyPlan {
  std::string name, title, question, file;
  std::string body;               ///< trail of the body measured; "": the one that nobody asks for
  bool match = false;             ///< laws of our engine get hookpoint's ground
  std::vector<std::string> only;  ///< subjects that run, where --only names some
  /// [s]; the duration is that of the longest case where each has its own.
  double settle = 0., duration = 0.;
  bool quick = false;
  std::vector<SweepPlan> sweeps;
  std::vector<SubjectPlan> subjects;
  std::vector<Assignment> fixes;                      ///< the study's own
  std::vector<std::string> scene_parameters;          ///< Params of the scene's file
  std::vector<SubjectInfo> compositions;              ///< engine, law, integrator, settings of rows
  std::vector<MeasuredCurves> curves;                 ///< of its Cases
  std::vector<std::filesystem::path> measured_files;  ///< tables of these
  std::vector<const MetricDefinition*> metrics;
  std::vector<std::shared_ptr<const UserMetric>> user_metrics;  ///< of those
  std::vector<ShownUnit> units;    ///< one a metric: that of its values in tables and Truths
  std::vector<int> metric_sweeps;  ///< one a metric: index of the sweep that it is over, else -1
  std::vector<TruthPlan> truths;
  std::vector<PlotPlan> plots;
  std::vector<TableSpec> tables;
  std::vector<ClaimSpec> claims;
  std::vector<RowPlan> rows;  ///< sweeps outermost first, subjects innermost
  std::string printed;        ///< the study as a file
  std::string scene_printed;  ///< the scene of the first row
  /// Of all that the study says, its scenes, and every file that they read, wherever these lie; not
  /// of the program and its engines.
  std::string hash;
  std::vector<output::InputFile> inputs;  ///< files that the study was made from and that it reads

  std::vector<std::string> settable;     ///< Params and objects at the top of its scenes
  std::set<std::uint64_t> seeds;         ///< of its rows
  language::Library* library = nullptr;  ///< with its scenes; outlives the plan

  /// Of runs whose step is above the largest stable one: "lugre: deltat 0.01 s is above ...".
  std::vector<std::string> warnings;

  bool covers(const std::vector<Condition>& conditions, const RowPlan& row) const;
  /// The values of the sweeps that the conditions let in, in the sweeps' units.
  SweepValues admitted(const std::vector<Condition>& conditions) const;
  /// Where its results go unless the user says otherwise: runs/<name>-<hash>.
  std::filesystem::path folder() const;
  /// What a row is called: "creep (dts_hookpoint, slope = 5 deg)".
  std::string name_of(const RowPlan& row) const;
  /// What a row's experiment is made of.
  RowScene scene_of(const RowPlan& row) const;
  /// The word of a World's field that the row's subject or a Sweep says; "": the scene's own.
  std::string world_word(const RowPlan& row, const std::string& field) const;
  /// The sweep of `seeds`; -1 without.
  int seed_sweep() const;
  /// The sweep of a Cases block; -1 without.
  int case_sweep() const;
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
