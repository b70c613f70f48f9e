// One run of a plan: steps an engine, shows every state to the metrics, keeps the traces.
#pragma once

#include <atomic>
#include <optional>
#include <string>
#include <vector>

#include "studies/plan/plan.h"

namespace hookpoint::studies {

struct RowOutcome {
  std::string status = "ok";
  std::vector<std::string> notices;             ///< of its engine
  std::vector<std::optional<double>> measured;  ///< one a metric of the plan
  std::vector<Trace> traces;  ///< one a plot of the plan, empty for those not over time
  /// Positions of the body's origin at `path_samples` equal intervals of the duration, where
  /// distances are measured: fewer of a run that did not finish [m].
  std::vector<Vector3d> path;
};

/// Most samples of a trace.
inline constexpr int trace_samples = 500;
/// Intervals between the samples of a path.
inline constexpr int path_samples = 200;

/// Runs `row`; nothing when `stop` was set meanwhile. Timing metrics stay empty. An engine that
/// fails gives a status, no exception.
std::optional<RowOutcome> execute(const StudyPlan& plan, const RowPlan& row,
                                  const EngineEntry* engine, const std::atomic<bool>& stop);

/// The timing metrics of `row`, one a metric of the plan (others empty): median over five stretches
/// of 200 steps. To be called while nothing else runs.
std::vector<std::optional<double>> execute_timing(const StudyPlan& plan, const RowPlan& row,
                                                  const EngineEntry& engine);

}  // namespace hookpoint::studies
