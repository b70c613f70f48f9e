// Metrics of what physics conserves: energy and momentum of a robot that nothing touches, and what
// a rebound and a support leave of them.
#include <algorithm>
#include <cmath>

#include "studies/metric.h"

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

class EnergyDrift : public Metric {
 public:
  explicit EnergyDrift(const RunContext& context) : context_(context) {}
  void observe(const Observation& observation) override {
    const double energy = mechanical_energy(context_, observation.world);
    if (!start_) start_ = energy;
    drift_ = std::max(drift_, std::abs(energy - *start_));
  }
  std::optional<double> value() const override { return drift_; }

 private:
  const RunContext& context_;
  std::optional<double> start_;
  double drift_ = 0.;
};

/// Gravity alone changes the momentum of what nothing touches: p = p0 + m g t.
class MomentumDrift : public Metric {
 public:
  explicit MomentumDrift(const RunContext& context) : context_(context) {}
  void observe(const Observation& observation) override {
    const Momentum now = momentum_of(context_, observation.world);
    if (!start_) start_ = now.linear;
    const Vector3d fallen = now.mass * observation.world.time * context_.experiment->gravity;
    drift_ = std::max(drift_, norm(now.linear - *start_ - fallen));
  }
  std::optional<double> value() const override { return drift_; }

 private:
  const RunContext& context_;
  std::optional<Vector3d> start_;
  double drift_ = 0.;
};

class AngularMomentumDrift : public Metric {
 public:
  explicit AngularMomentumDrift(const RunContext& context) : context_(context) {}
  void observe(const Observation& observation) override {
    const Vector3d now = momentum_of(context_, observation.world).angular;
    if (!start_) start_ = now;
    drift_ = std::max(drift_, norm(now - *start_));
  }
  std::optional<double> value() const override { return drift_; }

 private:
  const RunContext& context_;
  std::optional<Vector3d> start_;
  double drift_ = 0.;
};

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

}  // namespace

std::unique_ptr<Metric> make_energy_drift(const RunContext& context) {
  return std::make_unique<EnergyDrift>(context);
}
std::unique_ptr<Metric> make_momentum_drift(const RunContext& context) {
  return std::make_unique<MomentumDrift>(context);
}
std::unique_ptr<Metric> make_angular_momentum_drift(const RunContext& context) {
  return std::make_unique<AngularMomentumDrift>(context);
}
std::unique_ptr<Metric> make_rebound(const RunContext& context) {
  return std::make_unique<Rebound>(context);
}
std::unique_ptr<Metric> make_support_force(const RunContext& context) {
  return std::make_unique<SupportForce>(context);
}

}  // namespace hookpoint::studies
