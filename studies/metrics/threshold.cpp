// Metrics of the threshold of slip, of a body that is driven over it slowly.
#include <array>
#include <cmath>
#include <span>

#include "studies/measure/metric.h"
#include "studies/metrics/table.h"
#include "studies/predictions/predictions.h"

namespace hookpoint::studies {
namespace {

/// Weight of the robot and external forces on it, as they act in the step to come [N].
Vector3d driving_force(const RunContext& context, const Observation& observation) {
  const simulation::Experiment& experiment = *context.experiment;
  Vector3d force = (context.weight / norm(experiment.gravity)) * experiment.gravity;
  for (std::size_t i = 0; observation.inputs != nullptr && i < experiment.forces.size(); ++i) {
    if (experiment.forces[i].robot == context.robot) force += observation.inputs->forces[i].force;
  }
  return force;
}

/// Faster than `onset_speed` for `slip_lasts` on end after `settle`; a solver's twitch of a step is
/// no slip.
class SlipOnset : public Metric {
 public:
  explicit SlipOnset(const RunContext& context) : context_(context) {}
  void observe(const Observation& observation) override {
    if (slips_ || !settled(context_, observation)) return;
    if (norm(tangential(observation.body.velocity, context_.normal)) <= onset_speed) {
      since_.reset();
      return;
    }
    if (!since_) {
      since_ = observation.world.time;
      const Vector3d force = driving_force(context_, observation);
      angle_ = std::atan2(norm(tangential(force, context_.normal)), -dot(force, context_.normal));
    }
    slips_ = observation.world.time - *since_ >= slip_lasts - 1e-9;
  }
  std::optional<double> value() const override {
    return slips_ ? std::optional(angle_) : std::nullopt;
  }

 private:
  const RunContext& context_;
  std::optional<double> since_;  // [s]
  double angle_ = 0.;            // when that began [rad]
  bool slips_ = false;
};

class ThresholdError : public SlipOnset {
 public:
  explicit ThresholdError(const RunContext& context)
      : SlipOnset(context), friction_(static_friction(context)) {}
  std::optional<double> value() const override {
    const std::optional<double> onset = SlipOnset::value();
    return onset && friction_ ? std::optional(*onset - std::atan(*friction_)) : std::nullopt;
  }

 private:
  std::optional<double> friction_;
};

std::unique_ptr<Metric> make_slip_onset(const RunContext& context) {
  return std::make_unique<SlipOnset>(context);
}
std::unique_ptr<Metric> make_threshold_error(const RunContext& context) {
  return std::make_unique<ThresholdError>(context);
}

}  // namespace

std::span<const MetricDefinition> threshold_metrics() {
  static const auto rows = std::to_array<MetricDefinition>({
      {.name = "slip_onset",
       .unit = "rad",
       .doc =
           "angle of the driving force, weight and external forces, from the ground's normal when, after `settle`, the speed along the ground first exceeds 1 mm/s for 10 ms on end; nothing if it never does",
       .make = make_slip_onset,
       .predict = predicted::slip_onset},
      {.name = "threshold_error",
       .unit = "rad",
       .doc = "slip_onset less atan(mu_s)",
       .make = make_threshold_error,
       .predict = predicted::threshold_error},
  });
  return rows;
}

}  // namespace hookpoint::studies
