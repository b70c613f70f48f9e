// A Study block as a plan: every run there will be, checked, before the first one starts.
#pragma once

#include <filesystem>
#include <map>
#include <memory>
#include <optional>
#include <string>
#include <utility>
#include <vector>

#include "language/document.h"
#include "output/result_folder.h"
#include "simulation/experiment.h"
#include "studies/engine_table.h"
#include "studies/metric.h"
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
};

/// An `Only` block: some values of a swept Param.
struct Condition {
  int sweep = 0;
  std::vector<double> values;      ///< SI; empty: any within the bounds
  std::optional<double> from, to;  ///< SI
  bool holds(double value) const;
};

struct SweepPlan {
  SweepColumn column;
  std::vector<double> si;          ///< the same values in SI
  std::vector<std::string> texts;  ///< as the language writes them: "5 deg"
};

/// A Param and the text of its value.
struct Assignment {
  std::string parameter;
  std::string text;
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
  std::vector<int> subjects;  ///< empty: all
  std::vector<Condition> only;
  std::string name, words;
};

struct PlotPlan {
  PlotSpec spec;
  const SignalDefinition* signal = nullptr;  ///< over time
  std::vector<Condition> only;
};

struct RowPlan {
  std::vector<int> values;  ///< one index a sweep
  int subject = 0;
  using Heights = std::shared_ptr<const std::vector<double>>;

  simulation::Experiment experiment;  ///< without the heights of a ground that is a grid
  Heights heights;                    ///< those, shared by the rows that stand on them; or null
  /// The experiment as it is run.
  simulation::Experiment whole() const;
  std::string hash;  ///< of that and the files that it reads (simulation/identity.h)
  std::string
      refusal;  ///< why the row's engine cannot run the scene, which others can; "" if it can
  std::filesystem::path scene;        ///< its file
  std::vector<std::string> settings;  ///< what makes the experiment of it, as --set takes them
};

struct StudyPlan {
  std::string name, title, question, file;
  double settle = 0., duration = 0.;
  bool quick = false;
  std::vector<SweepPlan> sweeps;
  std::vector<SubjectPlan> subjects;
  std::vector<const MetricDefinition*> metrics;
  std::vector<int> metric_sweeps;  ///< one a metric: index of the sweep that it is over, else -1
  std::vector<TruthPlan> truths;
  std::vector<PlotPlan> plots;
  std::vector<RowPlan> rows;  ///< sweeps outermost first, subjects innermost
  std::string printed;        ///< the study as a file
  std::string scene_printed;  ///< the scene of the first row
  /// Of all that the study says, its scenes, and every file that they read, wherever these lie; not
  /// of the program and its engines.
  std::string hash;
  std::vector<output::InputFile> inputs;  ///< files that the study was made from and that it reads

  std::vector<std::string> settable;  ///< Params and objects at the top of its scenes

  /// Of runs whose step is above the largest stable one: "lugre: deltat 0.01 s is above ...".
  std::vector<std::string> warnings;

  bool covers(const std::vector<Condition>& conditions, const RowPlan& row) const;
  /// Where its results go unless the user says otherwise: runs/<name>-<hash>.
  std::filesystem::path folder() const;
  /// What a row is called: "creep (dts_hookpoint, slope = 5 deg)".
  std::string name_of(const RowPlan& row) const;
  /// What decides a row's outcome: the study's text, the row's experiment, this program, the
  /// engine.
  std::string identity_of(const RowPlan& row, const EngineTable& engines) const;
  /// Whether a metric of this scope is measured.
  bool measures(MetricScope scope) const;
  /// The rows that differ from `row` at most in the value of `sweep`, in its order; indices. Of no
  /// sweep, -1, the row alone.
  std::vector<std::size_t> rows_along(std::size_t row, int sweep) const;
};

/// The heights of the grounds of a plan's rows, equal ones kept once.
class SharedHeights {
 public:
  /// Moves the heights of the row's ground out of its experiment, to those that equal them.
  void take(RowPlan& row);

 private:
  std::map<std::string, RowPlan::Heights> known_;  ///< by their hash
};

/// runs/<name>-<the hash's first twelve digits>.
std::filesystem::path folder_of(const std::string& name, const std::string& hash);

/// The plan of `study` (an object of `root`, evaluated from `file`). Nothing when `diagnostics` got
/// an error: a misspelt name, a unit that does not fit, a value outside the scene's range, a law
/// that its integrator cannot advance. Every row's scene is evaluated and loaded here, in one
/// thread; running them needs no language any more.
std::optional<StudyPlan> make_plan(const language::Object& root, const language::Object& study,
                                   const std::string& file, language::Library& library,
                                   const EngineTable& engines, const PlanOptions& options,
                                   language::Diagnostics& diagnostics);

}  // namespace hookpoint::studies
