// What is measured: one definition a metric, the same code for every engine, from the published
// poses and velocities only. A metric sees every step once and keeps a fixed amount of memory,
// however long the run.
#pragma once

#include <memory>
#include <optional>
#include <span>
#include <string>
#include <string_view>

#include "studies/measure/observer.h"
#include "studies/measure/prediction.h"
#include "studies/measure/regime.h"
#include "studies/measure/signal.h"

namespace hookpoint::studies {

class Metric {
 public:
  virtual ~Metric() = default;
  /// Called once for the initial state and once after each step.
  virtual void observe(const Observation& observation) = 0;
  /// Nothing when it does not apply.
  virtual std::optional<double> value() const = 0;
  /// Of a run that the engine broke off; nothing but for a metric of just that.
  virtual std::optional<double> value_of_broken_run() const { return std::nullopt; }
  /// Why a run that finished has none, where there is more to say than that it does not apply.
  virtual std::string why_not() const { return ""; }
};

/// Which runs a metric's value is of.
enum class MetricScope {
  run,       ///< one
  sweep,     ///< those that differ in one swept value alone; a Metric gives each run's part
  subjects,  ///< those of all subjects at equal swept values; made of their paths
  timing     ///< one, that is run again alone
};

struct UserMetric;
struct PeerContact;

/// What a metric reads of a run beyond poses and velocities; each costs time at every step.
struct MetricNeeds {
  bool points = false;            ///< Observation::points
  bool forces = false;            ///< WorldState::ground_forces
  bool contact_force = false;     ///< that of bodies
  bool feet = false;              ///< Observation::feet
  bool stance = false;            ///< Observation::stance, of the gait
  bool numerical_energy = false;  ///< Observation::numerical_energy
};

/// A metric: a row in the file of its family (studies/metrics/table.h).
struct MetricDefinition {
  std::string_view name;
  std::string_view unit;
  std::string_view doc;
  /// Null if no single run has a value: of the scopes subjects and timing.
  std::unique_ptr<Metric> (*make)(const RunContext&) = nullptr;
  /// Closed form of the value in the run described by the context; null if none is known.
  Prediction (*predict)(const RunContext&, const PeerContact&) = nullptr;
  MetricNeeds needs = {};
  Regime regime = Regime::none;  ///< the only one in which it says something; none: any
  MetricScope scope = MetricScope::run;
  /// Of the scope timing: the value at a processor time a step [s] and a deltat [s]; nothing where
  /// the clock has not moved.
  std::optional<double> (*of_step_time)(double step_time, double deltat) = nullptr;
  const UserMetric* user = nullptr;  ///< whose definition it is; null of the table's
  bool timing() const { return scope == MetricScope::timing; }
};

/// Whether one of these metrics has this need.
inline bool any_needs(std::span<const MetricDefinition* const> metrics, bool MetricNeeds::*need) {
  for (const MetricDefinition* metric : metrics)
    if (metric->needs.*need) return true;
  return false;
}

/// Every metric, in the order of the manual.
std::span<const MetricDefinition> metric_table();
const MetricDefinition* find_metric(std::string_view name);

/// Speed along the ground from which a body counts as slipping, and below which as at rest [m/s].
inline constexpr double onset_speed = 1e-3;
/// How long it lasts where a slip begins [s].
inline constexpr double slip_lasts = 0.01;

/// A peer keeps a resting body within its own margin of the surface, so a touching point may lie
/// that far above it [m].
inline constexpr double touching_gap = 1e-4;

}  // namespace hookpoint::studies
