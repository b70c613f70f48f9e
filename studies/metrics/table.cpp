#include "studies/metrics/table.h"

#include <algorithm>
#include <array>
#include <string>
#include <string_view>
#include <vector>

namespace hookpoint::studies {
namespace {

/// The order of the manual.
constexpr auto order = std::to_array<std::string_view>({
    "creep_speed",
    "creep_sideways",
    "slip_acceleration",
    "friction",
    "anisotropy",
    "settle_shift",
    "stick_displacement",
    "slip_distance",
    "stopping_distance",
    "slip_onset",
    "threshold_error",
    "direction_error",
    "penetration_max",
    "penetration_mean",
    "penetration_rms",
    "contact_breaks",
    "impacts",
    "support_force",
    "force_residual",
    "force_residual_normal",
    "force_residual_cone",
    "force_residual_dissipation",
    "energy_residual",
    "numerical_energy",
    "numerical_energy_part",
    "joint_gap",
    "rebound",
    "energy_drift",
    "momentum_drift",
    "angular_momentum_drift",
    "energy_gain",
    "unrest",
    "restless",
    "stable_step",
    "spin_max",
    "fell",
    "walked_distance",
    "walking_speed",
    "foot_slip",
    "hook_losses",
    "stance_slip",
    "stance_depth",
    "stance_lift",
    "cost_of_transport",
    "body_height_min",
    "tilt_max",
    "integrator_steps",
    "rejected_steps",
    "evaluations",
    "jacobians",
    "events",
    "notices",
    "self_error",
    "truth_error",
    "reference_error",
    "peer_distance",
    "realtime_factor",
    "step_time",
});

constexpr auto families = std::to_array<std::span<const MetricDefinition> (*)()>({
    conservation_metrics,
    contact_metrics,
    force_metrics,
    integrator_metrics,
    joints_metrics,
    motion_metrics,
    stability_metrics,
    stance_metrics,
    threshold_metrics,
    walk_metrics,
    work_metrics,
    several_runs_metrics,
});

std::vector<MetricDefinition> metrics_in_order() {
  std::vector<MetricDefinition> metrics;
  for (const auto family : families)
    metrics.insert(metrics.end(), family().begin(), family().end());
  std::ranges::stable_sort(metrics, {}, [](const MetricDefinition& metric) {
    return std::ranges::find(order, metric.name) - order.begin();
  });
  return metrics;
}

}  // namespace

std::span<const std::string_view> metric_order() { return order; }

std::span<const MetricDefinition> metric_table() {
  static const std::vector<MetricDefinition> metrics = metrics_in_order();
  return metrics;
}

const MetricDefinition* find_metric(std::string_view name) {
  const auto metrics = metric_table();
  const auto found = std::ranges::find(metrics, name, &MetricDefinition::name);
  return found == metrics.end() ? nullptr : &*found;
}

}  // namespace hookpoint::studies
