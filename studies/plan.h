// A Study block as a plan: every run there will be, checked, before the first one starts.
#pragma once

#include <optional>
#include <string>
#include <vector>

#include "language/document.h"
#include "simulation/experiment.h"
#include "studies/engine_table.h"
#include "studies/metric.h"
#include "studies/result.h"

namespace hookpoint::studies {

struct PlanOptions {
  bool quick = false;
  std::vector<std::string> only;  ///< names of subjects; empty for all
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
  simulation::Experiment experiment;
  std::string
      refusal;  ///< why the row's engine cannot run the scene, which others can; "" if it can
};

struct StudyPlan {
  std::string name, title, question, file;
  double settle = 0., duration = 0.;
  bool quick = false;
  std::vector<SweepPlan> sweeps;
  std::vector<SubjectPlan> subjects;
  std::vector<const MetricDefinition*> metrics;
  std::vector<TruthPlan> truths;
  std::vector<PlotPlan> plots;
  std::vector<RowPlan> rows;  ///< sweeps outermost first, subjects innermost
  std::string printed;        ///< the study as a file
  std::string scene_printed;  ///< the scene of the first row
  std::string hash;           ///< of all that decides the results: 10 hexadecimal digits

  bool covers(const std::vector<Condition>& conditions, const RowPlan& row) const;
};

/// The plan of `study` (an object of `root`, evaluated from `file`). Nothing when `diagnostics` got
/// an error: a misspelt name, a unit that does not fit, a value outside the scene's range, a law
/// that its integrator cannot advance. Every row's scene is evaluated and loaded here, in one
/// thread; running them needs no language any more.
std::optional<StudyPlan> make_plan(const language::Object& root, const language::Object& study,
                                   const std::string& file, language::Library& library,
                                   const EngineTable& engines, const PlanOptions& options,
                                   language::Diagnostics& diagnostics);

}  // namespace hookpoint::studies
