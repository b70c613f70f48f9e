#include "reference/steady_creep.h"

#include <cmath>

namespace hookpoint::reference {
namespace {

/// Of the centre of mass: downhill and across [m/s], and the spin [rad/s].
using Motion = Vector3d;

/// The part of damping v that is left at a touching point at (x, y), 1 where it is not limited.
double left(const FrictionDamper& damper, const Motion& u, double x, double y) {
  const double load = std::hypot(damper.along * (u.x - u.z * y), damper.across * (u.y + u.z * x));
  return load > damper.limit ? damper.limit / load : 1.;
}

/// Sum of J^T C J over the touching points, C their damping at the motion `u` and J = [1 0 -y; 0 1
/// x].
Symmetric3d damping_at(const RestingBody& body, const std::vector<FrictionDamper>& dampers,
                       const Motion& u) {
  Symmetric3d sum;
  for (std::size_t i = 0; i < dampers.size(); ++i) {
    const auto [x, y, z] = body.in_slope(body.arms[i]);
    const double part = left(dampers[i], u, x, y);
    const double along = part * dampers[i].along, across = part * dampers[i].across;
    sum += Symmetric3d{along, across, along * y * y + across * x * x, 0., -along * y, across * x};
  }
  // A point under the centre of mass does not say how fast the body turns.
  if (sum.zz == 0.) sum.zz = 1.;
  return sum;
}

}  // namespace

simulation::ClosedForm<SteadyCreep> steady_creep(const RestingBody& body,
                                                 const std::vector<FrictionDamper>& dampers) {
  // The balance J^T C(u) J u = (pull, 0, 0) is that of the least of a convex function of u, and C
  // falls with speed: solved for u with the last C, again and again, it goes to the solution.
  constexpr int turns = 1000;
  Motion u;
  for (int i = 0; i < turns; ++i) {
    const Motion next = inverse(damping_at(body, dampers, u)) * Vector3d{body.pull, 0., 0.};
    const bool found = norm(next - u) <= 1e-12 * norm(next);
    u = next;
    if (!found) continue;
    const Vector3d origin = body.in_slope(body.origin);
    SteadyCreep creep{{u.x - u.z * origin.y, u.y + u.z * origin.x}, u.z};
    for (std::size_t k = 0; k < dampers.size(); ++k) {
      const auto [x, y, z] = body.in_slope(body.arms[k]);
      const double aside = std::abs(u.y + u.z * x) + std::abs(u.z * y);
      creep.straight = creep.straight && aside <= 1e-6 * u.x;
      creep.limited = creep.limited || left(dampers[k], u, x, y) < 1.;
    }
    return creep;
  }
  return simulation::NoClosedForm{"friction does not carry the body"};
}

simulation::ClosedForm<std::vector<FrictionDamper>> limits_without_friction(const RestingBody& body,
                                                                            double friction) {
  const auto loads = normal_loads(body, 0.);
  if (!loads) return loads.none();
  std::vector<FrictionDamper> dampers;
  for (const Vector3d& arm : body.arms)
    dampers.push_back({0., 0., friction * load_at(body, *loads, arm)});
  return dampers;
}

simulation::ClosedForm<SteadyCreep> creep_by_mixing(const RestingBody& body, double friction,
                                                    double mixing) {
  const auto limits = limits_without_friction(body, friction);
  if (!limits) return limits.none();
  std::vector<FrictionDamper> dampers = *limits;
  for (FrictionDamper& damper : dampers) damper.along = damper.across = 1. / mixing;
  return steady_creep(body, dampers);
}

simulation::ClosedForm<simulation::CreepVelocity> lasting(
    const SteadyCreep& creep, const simulation::Experiment& experiment) {
  if (std::abs(creep.spin) * experiment.duration > 0.2)
    return simulation::NoClosedForm{"the creeping body turns by more than 0.2 rad within the run"};
  return creep.velocity;
}

}  // namespace hookpoint::reference
