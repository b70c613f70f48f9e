// One run: steps an engine, shows every state to the metrics, records curves.
#pragma once

#include <atomic>
#include <memory>
#include <optional>
#include <span>
#include <string>
#include <vector>

#include "studies/measure/engine_table.h"
#include "studies/measure/metric.h"
#include "studies/metrics/user_metric.h"
#include "studies/results/result.h"
#include "studies/run/run_record.h"

namespace hookpoint::studies {

/// Under what a record keeps the values of a metric.
std::string kept_name(const MetricDefinition& metric);

/// A signal over time that a run records, evenly or, for a logarithmic axis, in geometric
/// progression.
struct RecordedSignal {
  const SignalDefinition* signal = nullptr;
  bool logarithmic = false;
  /// Of its curve: times, then as many values.
  std::string name() const;
};

/// What is looked at while a run continues.
struct Measurement {
  double settle = 0., duration = 0.;  ///< [s]
  std::vector<const MetricDefinition*> metrics;
  std::vector<RecordedSignal> signals;
  /// Whether positions of the body's origin are recorded, for distances between trajectories.
  bool path = false;

  /// Of the metrics, where no plan has them.
  std::vector<std::shared_ptr<const UserMetric>> owned = {};

  std::string body = {};  ///< trail of the body measured (studies/measure/measured_body.h)

  MeasuredTraces traces = {};  ///< that its metrics are of

  /// A run that ends by itself has its values, as one that came to the end of its duration.
  bool may_end = false;

  /// Whether `record` has all of it.
  bool found_in(const RunRecord& record) const;
};

/// What decides the numbers of a run, whatever study it stands in: experiment, times, what it is
/// held against, program, engine; as 32 hexadecimal digits. `experiment`: its hash
/// (simulation/engine_interface/identity.h).
std::string run_identity(const std::string& experiment, const Measurement& measurement,
                         const std::string& engine, const EngineTable& engines);

/// Most samples of a curve over time.
inline constexpr int trace_samples = 500;
/// Intervals between the samples of a path.
inline constexpr int path_samples = 200;
/// The curve of the path: x, y, z of the body's origin at `path_samples` equal intervals of the
/// duration, fewer of a run that did not finish [m].
inline constexpr const char* path_curve = "path";

Trace trace_of(const KeptCurve& curve);
std::vector<Vector3d> path_of(const KeptCurve& curve);

/// Runs the experiment; nothing when `stop` was set meanwhile. An engine that fails or is not there
/// gives a status, no exception. `refusal`: why the engine is not tried; "" to try.
std::optional<RunRecord> execute(const Measurement& measurement,
                                 const simulation::Experiment& experiment,
                                 const EngineTable& engines, const std::string& refusal,
                                 const std::atomic<bool>& stop);

/// The timing metrics among `metrics`: median over five stretches of 200 steps. To be called while
/// nothing else runs.
RunRecord execute_timing(std::span<const MetricDefinition* const> metrics,
                         const simulation::Experiment& experiment, const EngineEntry& engine);

}  // namespace hookpoint::studies
