// The work theorem, held against what an engine publishes: the kinetic and gravitational energy of
// a robot changes by the work of ground, joints and external forces. The ground's is
// -(dissipation + growth of the contact springs' energy), which nobody needs to tell apart.
#include <algorithm>
#include <array>
#include <cmath>
#include <optional>
#include <span>
#include <string>

#include "simulation/engine_interface/moving_energy.h"
#include "simulation/engine_interface/published_work.h"
#include "studies/measure/metric.h"
#include "studies/metrics/table.h"

namespace hookpoint::studies {
namespace {

using simulation::GroundForceTime;
using simulation::WorldState;

class EnergyResidual : public Metric {
 public:
  explicit EnergyResidual(const RunContext& context)
      : context_(context), step_(*context.experiment, static_cast<std::size_t>(context.robot)) {}

  void observe(const Observation& observation) override {
    const WorldState& world = observation.world;
    told_ = !context_.ground || world.ground_force_time != GroundForceTime::unknown;
    const double kinetic = kinetic_energy(context_, world);
    const double energy = mechanical_energy(context_, world);
    if (watching_) {
      const simulation::WorkParts work = step_.over_step(world);
      for (const double part : {work.ground, work.joints, work.forces}) add(part);
      exchanged_ += std::abs(energy - kinetic - potential_);
    } else {
      start_ = energy;
    }
    potential_ = energy - kinetic;
    greatest_kinetic_ = std::max(greatest_kinetic_, kinetic);
    residual_ = std::max(residual_, std::abs(energy - start_ - work_));
    step_.begin(world, observation.inputs);
    watching_ = true;
  }

  std::optional<double> value() const override {
    if (!told_ || !watching_) return std::nullopt;
    constexpr double least_fall = 1e-6;  // [m]: a robot that rests exchanges nothing but rounding
    const double scale = std::max(exchanged_ + greatest_kinetic_, context_.weight * least_fall);
    return residual_ == 0. ? 0. : residual_ / scale;
  }

 private:
  void add(double work) {
    work_ += work;
    exchanged_ += std::abs(work);
  }

  const RunContext& context_;
  simulation::PublishedWork step_;
  bool watching_ = false, told_ = false;
  double start_ = 0., potential_ = 0.;
  double work_ = 0., residual_ = 0., exchanged_ = 0., greatest_kinetic_ = 0.;  ///< [J]
};

/// Numerical energy since `settle` (docs/integrators.md), as it is or as a part of the energy that has
/// taken part in the motion.
class NumericalEnergy : public Metric {
 public:
  NumericalEnergy(const RunContext& context, bool as_part) : context_(context), as_part_(as_part) {
    if (as_part) moving_.emplace(*context.experiment, static_cast<std::size_t>(context.robot));
  }

  void observe(const Observation& observation) override {
    if (!settled(context_, observation) || !observation.numerical_energy) return;
    last_ = *observation.numerical_energy;
    driven_ = observation.driven_work;
    if (!first_) {
      first_ = last_;
      driven_before_ = driven_;
    }
    if (moving_) moving_->observe(observation.world);
  }

  std::optional<double> value() const override {
    if (!first_) return std::nullopt;
    const double energy = last_ - *first_;
    if (!as_part_) return energy;
    const double moving = moving_->value() + std::abs(driven_ - driven_before_);
    return moving > 0. ? std::optional(energy / moving) : std::nullopt;
  }

  std::string why_not() const override {
    return first_ ? "nothing moves to and fro that it could be a part of"
                  : "the engine does not tell the work of the ground";
  }

 private:
  const RunContext& context_;
  bool as_part_;
  std::optional<simulation::MovingEnergy> moving_;
  std::optional<double> first_;              ///< [J]
  double last_ = 0.;                         ///< [J]
  double driven_ = 0., driven_before_ = 0.;  ///< work of drives until now, and until `first_` [J]
};

std::unique_ptr<Metric> make_numerical_energy(const RunContext& context) {
  return std::make_unique<NumericalEnergy>(context, false);
}
std::unique_ptr<Metric> make_numerical_energy_part(const RunContext& context) {
  return std::make_unique<NumericalEnergy>(context, true);
}

/// Without errors of integration.
Prediction none(const RunContext& /*context*/, const PeerContact& /*peer*/) { return 0.; }

std::unique_ptr<Metric> make_energy_residual(const RunContext& context) {
  return std::make_unique<EnergyResidual>(context);
}

}  // namespace

std::span<const MetricDefinition> work_metrics() {
  static const auto rows = std::to_array<MetricDefinition>({
      {.name = "energy_residual",
       .unit = "",
       .doc =
           "greatest difference, since the start, between the change of kinetic and gravitational energy and the work of ground, joints and external forces, per energy exchanged",
       .make = make_energy_residual,
       .needs = {.forces = true}},
      {.name = "numerical_energy",
       .unit = "J",
       .doc =
           "change of kinetic and gravitational energy since `settle`, less the work of all that acts on the robot: what the integration has added",
       .make = make_numerical_energy,
       .predict = none,
       .needs = {.numerical_energy = true}},
      {.name = "numerical_energy_part",
       .unit = "",
       .doc =
           "the same per energy that takes part in the motion, not that of a wheel which turns steadily: the work of drives, and half the sum of the ranges of each body's kinetic energies along and about its axes, of its springs and of its weight",
       .make = make_numerical_energy_part,
       .predict = none,
       .needs = {.numerical_energy = true}},
  });
  return rows;
}

}  // namespace hookpoint::studies
