// Metrics of a robot that should come to rest: whether its contacts and its integrator let it.
#include "simulation/analysis/stability.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <span>

#include "contact/force_law.h"
#include "studies/measure/metric.h"
#include "studies/metrics/table.h"
#include "studies/predictions/predictions.h"

namespace hookpoint::studies {
namespace {

class Unrest : public Metric {
 public:
  explicit Unrest(const RunContext& context)
      : context_(context), mass_(context.weight / norm(context.experiment->gravity)) {}
  void observe(const Observation& observation) override {
    if (settled(context_, observation))
      energy_ = std::max(energy_, kinetic_energy(context_, observation.world));
  }
  std::optional<double> value() const override { return std::sqrt(2. * energy_ / mass_); }

 private:
  const RunContext& context_;
  double mass_, energy_ = 0.;
};

class Restless : public Unrest {
 public:
  using Unrest::Unrest;
  std::optional<double> value() const override { return *Unrest::value() > onset_speed ? 1. : 0.; }
  std::optional<double> value_of_broken_run() const override { return 1.; }
};

/// Of the experiment alone, whatever becomes of the run.
class StableStep : public Metric {
 public:
  explicit StableStep(const RunContext& context) : context_(context) {}
  void observe(const Observation&) override {}
  std::optional<double> value() const override {
    const simulation::Experiment& experiment = *context_.experiment;
    if (experiment.engine != "dts" || !contact::find_force_law(experiment.contact))
      return std::nullopt;
    const double step = simulation::stability_bound(experiment).step;
    return std::isfinite(step) ? std::optional(step) : std::nullopt;
  }
  std::optional<double> value_of_broken_run() const override { return value(); }

 private:
  const RunContext& context_;
};

std::unique_ptr<Metric> make_unrest(const RunContext& context) {
  return std::make_unique<Unrest>(context);
}
std::unique_ptr<Metric> make_restless(const RunContext& context) {
  return std::make_unique<Restless>(context);
}
std::unique_ptr<Metric> make_stable_step(const RunContext& context) {
  return std::make_unique<StableStep>(context);
}

}  // namespace

std::span<const MetricDefinition> stability_metrics() {
  static const auto rows = std::to_array<MetricDefinition>({
      {.name = "unrest",
       .unit = "m/s",
       .doc = "greatest sqrt(2 T/m) after `settle`, T the kinetic energy of the robot, m its mass",
       .make = make_unrest},
      {.name = "restless",
       .unit = "",
       .doc =
           "1 if unrest is above 1 mm/s or the engine broke the run off: what should rest does not; else 0",
       .make = make_restless,
       .predict = predicted::restless},
      {.name = "stable_step",
       .unit = "s",
       .doc =
           "largest stable step of the run's integrator at its start (docs/contact.md); nothing for another engine, an impulse law or an adaptive integrator",
       .make = make_stable_step},
  });
  return rows;
}

}  // namespace hookpoint::studies
