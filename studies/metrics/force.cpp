// Metrics of the ground's single forces against the three laws of rigid contact with friction.
// With F_n and F_t the force of a contact along the normal and the ground, v_n and v_t the velocity
// of the body's material there, away from the ground and along it:
//   Signorini             0 <= F_n, and F_n v_n = 0;   F_n = 0 across a gap
//   Coulomb               |F_t| <= mu_s F_n
//   maximum dissipation   F_t . v_t = -mu_k F_n |v_t|
// The products are powers, and together the complementarity of the cone with de Saxce's velocity
// that Le Lidec et al., Contact Models in Robotics: a Comparative Analysis (2023), hold solvers to.
// Over the speed they are newtons; below `onset_speed` a contact counts as at rest, and they fade.
#include <algorithm>
#include <array>
#include <cmath>
#include <span>

#include "studies/measure/metric.h"
#include "studies/metrics/table.h"

namespace hookpoint::studies {
namespace {

/// Of one contact [N].
struct Residuals {
  double normal = 0., cone = 0., dissipation = 0.;
};

Residuals residuals_of(const Vector3d& force, const Vector3d& velocity,
                       const contact::TilePoint& tile,
                       const contact::MaterialConstants<double>& material) {
  const Vector3d force_t = tangential(force, tile.normal);
  const Vector3d velocity_t = tangential(velocity, tile.normal);
  const double force_n = dot(force, tile.normal), carried = std::max(force_n, 0.);
  const double speed_n = std::abs(dot(velocity, tile.normal)), speed_t = norm(velocity_t);
  const double sticking = std::max(material.static_friction, material.kinetic_friction);
  Residuals residuals;
  const bool apart = tile.depth < -touching_gap;
  residuals.normal = force_n < 0. || apart ? std::abs(force_n)
                                           : force_n * speed_n / std::max(speed_n, onset_speed);
  residuals.cone = std::max(norm(force_t) - sticking * carried, 0.);
  const double missing = material.kinetic_friction * carried * speed_t + dot(force_t, velocity_t);
  residuals.dissipation = std::max(missing / std::max(speed_t, onset_speed), 0.);
  return residuals;
}

class ForceResidual : public Metric {
 public:
  explicit ForceResidual(const RunContext& context) : context_(context) {}
  void observe(const Observation& observation) override {
    const simulation::WorldState& world = observation.world;
    told_ = world.ground_force_time != simulation::GroundForceTime::unknown;
    if (!context_.ground || world.step == 0 || !settled(context_, observation)) return;
    for_each_ground_force(
        context_, world, [this](const auto& force, const auto& body, const Vector3d& arm) {
          const contact::TilePoint tile = context_.ground->query(body.position + arm);
          const Vector3d velocity = body.velocity + cross(body.angular_velocity, arm);
          const auto& material =
              context_.experiment->materials[static_cast<std::size_t>(tile.material)];
          const Residuals one = residuals_of(force.force, velocity, tile, material.constants);
          sum_.normal += one.normal;
          sum_.cone += one.cone;
          sum_.dissipation += one.dissipation;
        });
    ++count_;
  }
  std::optional<double> value() const override {
    return mean(sum_.normal + sum_.cone + sum_.dissipation);
  }

 protected:
  const Residuals& sum() const { return sum_; }
  std::optional<double> mean(double sum) const {
    if (!told_ || count_ == 0) return std::nullopt;
    return sum / static_cast<double>(count_);
  }

 private:
  const RunContext& context_;
  Residuals sum_;
  bool told_ = false;
  long count_ = 0;
};

class ForceResidualPart : public ForceResidual {
 public:
  ForceResidualPart(const RunContext& context, double Residuals::*part)
      : ForceResidual(context), part_(part) {}
  std::optional<double> value() const override { return mean(sum().*part_); }

 private:
  double Residuals::*part_;
};

std::unique_ptr<Metric> make_force_residual(const RunContext& context) {
  return std::make_unique<ForceResidual>(context);
}
std::unique_ptr<Metric> make_force_residual_normal(const RunContext& context) {
  return std::make_unique<ForceResidualPart>(context, &Residuals::normal);
}
std::unique_ptr<Metric> make_force_residual_cone(const RunContext& context) {
  return std::make_unique<ForceResidualPart>(context, &Residuals::cone);
}
std::unique_ptr<Metric> make_force_residual_dissipation(const RunContext& context) {
  return std::make_unique<ForceResidualPart>(context, &Residuals::dissipation);
}

}  // namespace

std::span<const MetricDefinition> force_metrics() {
  static const auto rows = std::to_array<MetricDefinition>({
      {.name = "force_residual",
       .unit = "N",
       .doc =
           "mean after `settle` of what the ground's single forces owe Signorini, Coulomb and maximum dissipation: the sum of its parts _normal, _cone and _dissipation; nothing for an engine that does not tell them",
       .make = make_force_residual,
       .needs = {.forces = true}},
      {.name = "force_residual_normal",
       .unit = "N",
       .doc =
           "of it, normal forces that pull, that act across a gap, or while the contact opens or closes",
       .make = make_force_residual_normal,
       .needs = {.forces = true}},
      {.name = "force_residual_cone",
       .unit = "N",
       .doc = "of it, tangential force beyond mu times the normal force",
       .make = make_force_residual_cone,
       .needs = {.forces = true}},
      {.name = "force_residual_dissipation",
       .unit = "N",
       .doc = "of it, what friction lacks of mu times the normal force against the slip",
       .make = make_force_residual_dissipation,
       .needs = {.forces = true}},
  });
  return rows;
}

}  // namespace hookpoint::studies
