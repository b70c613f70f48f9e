// Objective blocks: what a Tune makes small or great; and Require blocks: what it may not leave.
#pragma once

#include <cmath>
#include <cstddef>
#include <optional>
#include <string>

#include "language/diagnostics.h"
#include "language/schema/schema.h"
#include "language/tree/object.h"
#include "studies/measure/metric.h"

namespace hookpoint::studies {

struct StudyParts;

/// Statistic of the values with each seed.
enum class SeedsTake { mean, worst };

/// An Objective block. What is minimised or maximised is the metric or, where there is a target,
/// minimised the distance of the metric from it in each run, in the metric's unit.
struct ObjectivePlan {
  using Take = SeedsTake;
  std::size_t metric = 0;  ///< index into StudyParts::metrics
  bool maximise = false;
  Take take = Take::mean;
  std::optional<double> target = {};  ///< in the metric's unit
  std::string target_text = {};       ///< as its author wrote it: "3 mm"
  /// Of a target that is written in another unit than the metric's: that unit, and how many of them
  /// the metric's is.
  std::string written_unit = {};
  double in_written_unit = 1.;
  bool may_be_empty = false;  ///< it may judge nothing

  /// What the objective is for a run with this value of the metric.
  double of_run(double value) const { return target ? std::abs(value - *target) : value; }
};

/// A Require block.
struct RequirementPlan {
  std::size_t metric = 0;  ///< index into StudyParts::metrics
  std::optional<double> equals, above, below;
  double within = 0.;
  std::string words;          ///< "stable_step is above 0.5 ms"
  bool may_be_empty = false;  ///< it may judge nothing

  /// How far a value is from what is required, as a part of the bound's magnitude (of 1 where that
  /// is 0); 0 where it holds.
  double missed_by(double value) const;
};

/// With `minimise` and `maximise`.
void add_objective_classes(language::Schema& schema);
void add_require_class(language::Schema& schema);

/// False, after an error, where a run alone has no value of the metric that the block names.
bool check_of_one_run(const language::Object& block, const MetricDefinition& metric,
                      language::Diagnostics& diagnostics);

/// Both add the metric that the block names to those that are measured, where it is not among them.
/// Nothing after an error that makes the block meaningless.
std::optional<ObjectivePlan> load_objective(const language::Object& block, StudyParts& so_far,
                                            language::Diagnostics& diagnostics);
std::optional<RequirementPlan> load_requirement(const language::Object& block, StudyParts& so_far,
                                                language::Diagnostics& diagnostics);

}  // namespace hookpoint::studies
