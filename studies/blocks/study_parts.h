// What the blocks of a Study say, as far as they are loaded: each block is checked against those
// before it. The plan adds the runs.
#pragma once

#include <cstddef>
#include <filesystem>
#include <memory>
#include <string>
#include <string_view>
#include <vector>

#include "language/document/document.h"
#include "studies/blocks/case_table.h"
#include "studies/blocks/cases.h"
#include "studies/blocks/claim.h"
#include "studies/blocks/only.h"
#include "studies/blocks/plot.h"
#include "studies/blocks/subject.h"
#include "studies/blocks/sweep.h"
#include "studies/blocks/table.h"
#include "studies/blocks/truth.h"
#include "studies/measure/metric.h"
#include "studies/metrics/user_metric.h"
#include "studies/results/assignment.h"
#include "studies/results/result.h"

namespace hookpoint::studies {

/// The unit in which a study has a metric. A run has one of the user's own in this unit already.
struct ShownUnit {
  std::string text;   ///< "mm/s"
  double scale = 1.;  ///< of a run's value by it
};

/// A metric that the study measures, and how it shows it.
struct MeasuredMetric {
  const MetricDefinition* definition = nullptr;
  ShownUnit unit = {};  ///< that of its values in tables and Truths
  int sweep = -1;       ///< index of the sweep that it is over; -1 for none
};

struct StudyParts {
  std::string name, title, question, file;
  std::string body;    ///< trail of the body measured; "": the scene's first
  bool match = false;  ///< laws of our engine get hookpoint's ground
  /// [s]; the duration is that of the longest case where each has its own.
  double settle = 0., duration = 0.;
  bool quick = false;
  std::vector<SweptGround> grounds;  ///< that a Sweep `terrain` names
  std::vector<SweepPlan> sweeps;
  std::vector<CaseRow> cases;  ///< of the Cases block that run
  std::vector<SubjectPlan> subjects;
  std::vector<Assignment> fixes;                      ///< the study's own
  std::vector<std::string> scene_parameters;          ///< Params of the scene's file
  std::vector<MeasuredCurves> curves;                 ///< of its Cases
  std::vector<std::filesystem::path> measured_files;  ///< tables of these
  std::vector<MeasuredMetric> metrics;
  std::vector<std::shared_ptr<const UserMetric>> user_metrics;  ///< of those
  std::vector<TruthPlan> truths;
  std::vector<PlotPlan> plots;
  std::vector<TableSpec> tables;
  std::vector<ClaimSpec> claims;
  language::Library* library = nullptr;  ///< with its scenes; outlives the plan

  /// Params of the scene and of its grounds.
  std::vector<std::string> parameters() const;
  std::vector<std::string> sweep_names() const;
  int sweep_index(std::string_view sweep) const;  ///< -1 for none
  std::vector<std::string> subject_names() const;
  std::vector<const MetricDefinition*> metric_definitions() const;  ///< of those that are measured
  std::vector<std::string> metric_names() const;                    ///< of those
  std::ptrdiff_t metric_index(std::string_view metric) const;       ///< of those; -1 for none
  /// Whether a Sweep or a table of cases sets the Param.
  bool is_varied(const std::string& parameter) const;
  /// The sweep of `seeds`; -1 without.
  int seed_sweep() const;
  /// The sweep of a Cases block; -1 without.
  int case_sweep() const;
  /// The values of the sweeps that the conditions let in, in the sweeps' units.
  SweepValues admitted(const std::vector<Condition>& conditions) const;
};

/// Names of the metrics that there are.
std::vector<std::string> metric_names();

/// The unit of the metric that the field names; an error where the study does not measure it.
std::string metric_unit(const language::Placed<std::string>& metric, const StudyParts& so_far,
                        language::Diagnostics& diagnostics);

}  // namespace hookpoint::studies
