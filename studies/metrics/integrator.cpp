// Metrics of the integration itself: what it cost, and how far it is from its own limit.
#include <algorithm>
#include <array>
#include <cmath>
#include <span>

#include "contact/force_law.h"
#include "simulation/dts_engine/dts_engine.h"
#include "simulation/run/loop.h"
#include "simulation/run/world.h"
#include "studies/measure/metric.h"
#include "studies/metrics/table.h"
#include "studies/predictions/predictions.h"

namespace hookpoint::studies {
namespace {

/// A count of the run's integrator at the end; nothing for an engine that does not say.
class IntegratorCount : public Metric {
 public:
  explicit IntegratorCount(double simulation::IntegratorState::*count) : count_(count) {}
  void observe(const Observation& observation) override { last_ = observation.world.integrator; }
  std::optional<double> value() const override {
    return last_.evaluations > 0. ? std::optional(last_.*count_) : std::nullopt;
  }

 private:
  double simulation::IntegratorState::*count_;
  simulation::IntegratorState last_;
};

/// Distance from a run of the same scene, nearer to the limit of vanishing steps, that goes on
/// beside this one with `steps` of its own in one of this.
class DistanceFromLimit : public Metric {
 public:
  DistanceFromLimit(const RunContext& context, simulation::Experiment nearer, std::int64_t steps)
      : body_(context.watched), steps_(steps), nearer_(std::move(nearer)) {
    if (context.make == nullptr) return;
    nearer_.deltat = context.experiment->deltat / static_cast<double>(steps);
    world_ = std::make_unique<simulation::World>(nearer_, context.make(nearer_));
  }

  void observe(const Observation& observation) override {
    if (!world_) return;
    const std::int64_t wanted = steps_ * observation.world.step;
    const simulation::RunEnd end = simulation::run_until(
        *world_, wanted, [] { return true; }, [] {});
    if (!end.complete()) {
      world_.reset();
      return;
    }
    const Vector3d apart = observation.body.position - world_->state().bodies[body_].position;
    error_ = std::max(error_.value_or(0.), norm(apart));
  }

  std::optional<double> value() const override { return world_ ? error_ : std::nullopt; }

 private:
  std::size_t body_;
  std::int64_t steps_;
  simulation::Experiment nearer_;
  std::unique_ptr<simulation::World> world_;
  std::optional<double> error_;
};

class NoticeCount : public Metric {
 public:
  void observe(const Observation& observation) override {
    count_ = static_cast<double>(observation.world.notices.size());
  }
  std::optional<double> value() const override { return count_; }

 private:
  double count_ = 0.;
};

class TruthError : public Metric {
 public:
  explicit TruthError(const RunContext& context) : slide_(rigid_slide(context)) {}
  void observe(const Observation& observation) override {
    if (!slide_) return;
    const double apart = observation.displacement - slide_->displacement(observation.world.time);
    error_ = std::max(error_.value_or(0.), std::abs(apart));
  }
  std::optional<double> value() const override { return error_; }

 private:
  std::optional<RigidSlide> slide_;
  std::optional<double> error_;
};

std::unique_ptr<Metric> make_notices(const RunContext&) { return std::make_unique<NoticeCount>(); }
std::unique_ptr<Metric> make_truth_error(const RunContext& context) {
  return std::make_unique<TruthError>(context);
}
std::unique_ptr<Metric> make_integrator_steps(const RunContext&) {
  return std::make_unique<IntegratorCount>(&simulation::IntegratorState::steps);
}
std::unique_ptr<Metric> make_rejected_steps(const RunContext&) {
  return std::make_unique<IntegratorCount>(&simulation::IntegratorState::rejected);
}
std::unique_ptr<Metric> make_evaluations(const RunContext&) {
  return std::make_unique<IntegratorCount>(&simulation::IntegratorState::evaluations);
}
std::unique_ptr<Metric> make_jacobians(const RunContext&) {
  return std::make_unique<IntegratorCount>(&simulation::IntegratorState::jacobians);
}
std::unique_ptr<Metric> make_events(const RunContext&) {
  return std::make_unique<IntegratorCount>(&simulation::IntegratorState::events);
}
std::unique_ptr<Metric> make_self_error(const RunContext& context) {
  constexpr int refinement = 8;
  constexpr double tighter = 0.01;
  simulation::Experiment nearer = *context.experiment;
  nearer.relative_tolerance = std::max(tighter * nearer.relative_tolerance, 1e-13);
  nearer.absolute_tolerance *= tighter;
  return std::make_unique<DistanceFromLimit>(context, std::move(nearer), refinement);
}
std::unique_ptr<Metric> make_reference_error(const RunContext& context) {
  constexpr double longest_step = 1e-4;  // [s]
  simulation::Experiment nearer = *context.experiment;
  nearer.integrator = "arkode";
  nearer.relative_tolerance = 1e-10;
  nearer.absolute_tolerance = 1e-12;
  const auto steps = std::ceil(nearer.deltat / longest_step - 1e-9);
  RunContext own = context;
  if (!context.ground) {  // Newton and Euler alone: every engine means the same motion
    nearer.engine = "dts";
    nearer.contact = contact::Hookpoint::name;
    own.make = simulation::make_dts;
  } else if (nearer.engine != "dts" || !contact::find_force_law(nearer.contact)) {
    own.make = nullptr;
  }
  return std::make_unique<DistanceFromLimit>(own, std::move(nearer),
                                             static_cast<std::int64_t>(steps));
}

}  // namespace

std::span<const MetricDefinition> integrator_metrics() {
  static const auto rows = std::to_array<MetricDefinition>({
      {.name = "integrator_steps",
       .unit = "",
       .doc = "steps of the integrator, of an adaptive one its internal steps",
       .make = make_integrator_steps},
      {.name = "rejected_steps",
       .unit = "",
       .doc = "steps that an adaptive integrator took back",
       .make = make_rejected_steps},
      {.name = "evaluations",
       .unit = "",
       .doc = "evaluations of accelerations, those for Jacobians included",
       .make = make_evaluations},
      {.name = "jacobians",
       .unit = "",
       .doc = "Jacobian matrices by difference quotients",
       .make = make_jacobians},
      {.name = "events",
       .unit = "",
       .doc =
           "touch-downs, lift-offs, ends of slip, joint limits at which an adaptive integrator restarted",
       .make = make_events},
      {.name = "notices",
       .unit = "",
       .doc =
           "warnings that the engine gave, each once: 1 for ODE where its solver reported failures",
       .make = make_notices},
      {.name = "self_error",
       .unit = "m",
       .doc =
           "greatest distance of the body's origin from the same run nearer to its limit: an eighth of deltat, a hundredth of the tolerances",
       .make = make_self_error},
      {.name = "truth_error",
       .unit = "m",
       .doc =
           "greatest distance of the downhill displacement from that of a rigid block under Coulomb friction",
       .make = make_truth_error},
      {.name = "reference_error",
       .unit = "m",
       .doc =
           "greatest distance of the body's origin from the run of arkode with tolerances of 1e-10 and steps of 0.1 ms or less, for another engine only where there is no ground",
       .make = make_reference_error},
  });
  return rows;
}

}  // namespace hookpoint::studies
