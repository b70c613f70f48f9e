// Metrics of what physics conserves: energy and momentum of a robot that nothing touches, and what
// a rebound and a support leave of them.
#include <algorithm>
#include <array>
#include <cmath>
#include <span>
#include <type_traits>

#include "studies/measure/metric.h"
#include "studies/metrics/table.h"
#include "studies/predictions/predictions.h"

namespace hookpoint::studies {
namespace {

/// Of all bodies of the measured robot: mass, centre of mass, momenta, angular momentum about that
/// centre.
struct Momentum {
  double mass = 0.;
  Vector3d center;   ///< [m]
  Vector3d linear;   ///< [kg m/s]
  Vector3d angular;  ///< [kg m^2/s]
};

Momentum momentum_of(const RunContext& context, const simulation::WorldState& world) {
  Momentum sum;
  Vector3d about_origin;
  for_each_body(
      context, world, [&](const simulation::BodySpec& spec, const simulation::BodyState& body) {
        const double mass = spec.mass.mass;
        const Vector3d arm = rotate(body.orientation, spec.mass.center_of_mass);
        const Vector3d place = body.position + arm;
        const Vector3d linear = mass * (body.velocity + cross(body.angular_velocity, arm));
        const Vector3d w_B = rotate(conjugate(body.orientation), body.angular_velocity);
        sum.mass += mass;
        sum.center += mass * place;
        sum.linear += linear;
        about_origin += cross(place, linear) + rotate(body.orientation, spec.mass.inertia * w_B);
      });
  sum.center = (1. / sum.mass) * sum.center;
  sum.angular = about_origin - cross(sum.center, sum.linear);
  return sum;
}

double magnitude(double difference) { return std::abs(difference); }
double magnitude(const Vector3d& difference) { return norm(difference); }

/// Greatest change since the start of what `quantity(context, world)` gives.
template <class Quantity>
class Drift : public Metric {
 public:
  Drift(const RunContext& context, Quantity quantity) : context_(context), quantity_(quantity) {}
  void observe(const Observation& observation) override {
    const auto now = quantity_(context_, observation.world);
    if (!start_) start_ = now;
    drift_ = std::max(drift_, magnitude(now - *start_));
  }
  std::optional<double> value() const override { return drift_; }

 private:
  const RunContext& context_;
  Quantity quantity_;
  std::optional<std::invoke_result_t<Quantity, const RunContext&, const simulation::WorldState&>>
      start_;
  double drift_ = 0.;
};

/// Gravity alone changes the momentum of what nothing touches: p - m g t = p0.
Vector3d momentum_less_fall(const RunContext& context, const simulation::WorldState& world) {
  const Momentum now = momentum_of(context, world);
  return now.linear - now.mass * world.time * context.experiment->gravity;
}

Vector3d angular_momentum(const RunContext& context, const simulation::WorldState& world) {
  return momentum_of(context, world).angular;
}

/// Speed away from the ground after the contact over the speed towards it before.
class Rebound : public Metric {
 public:
  explicit Rebound(const RunContext& context) : context_(context) {}
  void observe(const Observation& observation) override {
    const double away = dot(observation.body.velocity, context_.normal);
    approach_ = std::max(approach_, -away);
    rebound_ = std::max(rebound_, away);
  }
  std::optional<double> value() const override {
    return approach_ > 0. ? std::optional(rebound_ / approach_) : std::nullopt;
  }

 private:
  const RunContext& context_;
  double approach_ = 0., rebound_ = 0.;
};

class SupportForce : public Metric {
 public:
  explicit SupportForce(const RunContext& context) : context_(context) {}
  void observe(const Observation& observation) override {
    if (!settled(context_, observation)) return;
    for_each_body(context_, observation.world,
                  [this](const simulation::BodySpec&, const simulation::BodyState& body) {
                    sum_ += dot(body.contact_force, context_.normal);
                  });
    ++count_;
  }
  std::optional<double> value() const override {
    return count_ > 0 ? std::optional(sum_ / static_cast<double>(count_)) : std::nullopt;
  }

 private:
  const RunContext& context_;
  double sum_ = 0.;
  long count_ = 0;
};

std::unique_ptr<Metric> make_energy_drift(const RunContext& context) {
  return std::make_unique<Drift<decltype(&mechanical_energy)>>(context, &mechanical_energy);
}
std::unique_ptr<Metric> make_momentum_drift(const RunContext& context) {
  return std::make_unique<Drift<decltype(&momentum_less_fall)>>(context, &momentum_less_fall);
}
std::unique_ptr<Metric> make_angular_momentum_drift(const RunContext& context) {
  return std::make_unique<Drift<decltype(&angular_momentum)>>(context, &angular_momentum);
}
std::unique_ptr<Metric> make_rebound(const RunContext& context) {
  return std::make_unique<Rebound>(context);
}
std::unique_ptr<Metric> make_support_force(const RunContext& context) {
  return std::make_unique<SupportForce>(context);
}

}  // namespace

std::span<const MetricDefinition> conservation_metrics() {
  static const auto rows = std::to_array<MetricDefinition>({
      {.name = "support_force",
       .unit = "N",
       .doc = "mean force of the ground along its normal after `settle`, on all bodies",
       .make = make_support_force,
       .predict = predicted::support_force,
       .needs = {.contact_force = true}},
      {.name = "rebound",
       .unit = "",
       .doc =
           "greatest speed away from the ground over the greatest towards it, of the body's origin",
       .make = make_rebound,
       .predict = predicted::rebound},
      {.name = "energy_drift",
       .unit = "J",
       .doc = "greatest change of kinetic and gravitational energy since the start, either way",
       .make = make_energy_drift},
      {.name = "momentum_drift",
       .unit = "kg.m/s",
       .doc = "greatest distance of the momentum from that of a free flight, p0 + m g t",
       .make = make_momentum_drift},
      {.name = "angular_momentum_drift",
       .unit = "kg.m^2/s",
       .doc = "greatest change of the angular momentum about the centre of mass",
       .make = make_angular_momentum_drift},
  });
  return rows;
}

}  // namespace hookpoint::studies
