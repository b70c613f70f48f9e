#include "reference/mujoco/contact_at_rest.h"

#include <algorithm>
#include <cmath>
#include <optional>

#include "math/bisect.h"
#include "reference/steady_creep.h"

namespace hookpoint::reference {
namespace {

/// Rows of a pyramid at rest carry f = max(0, q -+ w) for a depth q and a speed w along each
/// tangent, in units of the mean normal load.
struct Pyramid {
  double depth = 0., along = 0., across = 0.;
};

/// Opposite rows carry a load t = f_t/mu together: both while t <= 2 q, and then w = t/2; else the
/// one that is left, and w = t - q. All rows together carry 1.
std::optional<Pyramid> pyramid_at_rest(double t, double u, double least, double largest) {
  if (t + u >= 1.) return std::nullopt;  // beyond the pyramid
  const double q = std::min(0.25, 0.5 * (1. - std::max(t, u)));
  const auto speed = [q](double load) { return load <= 2. * q ? 0.5 * load : load - q; };
  const Pyramid mean{q, speed(t), speed(u)};
  // A contact with another normal load has another depth: rows each way carry max(2 q, q + w). The
  // mean is the mean of all only if the same rows carry everywhere.
  const int lost = (mean.along > q ? 1 : 0) + (mean.across > q ? 1 : 0);
  for (const double normal : {least, largest}) {
    const double depth = q + (normal - 1.) / (4. - lost);
    if (!(depth > 0.) || (mean.along > q) != (mean.along > depth) ||
        (mean.across > q) != (mean.across > depth))
      return std::nullopt;
  }
  return mean;
}

/// At impedance `d`.
simulation::ClosedForm<MujocoRest> rest_at(const MujocoLoad& load, const MujocoSettings& settings,
                                           const contact::MujocoReference& reference, double d) {
  const double softness = (1. - d) / d * load.inverse_weight;
  const double mu = load.friction;
  if (settings.friction.elliptic) {
    if (load.tangential > mu * load.least * load.normal) return point_at_limit;
    return MujocoRest{
        {softness / settings.friction.impedance_ratio * load.tangential / reference.damping, 0.},
        softness * load.normal / (reference.stiffness * d)};
  }
  const double row = contact::mujoco_pyramid_softness(mu, settings.friction, softness);
  const double part = load.tangential / (mu * load.normal);
  const auto pyramid =
      pyramid_at_rest(part * load.along, part * load.across, load.least, load.largest);
  if (!pyramid)
    return simulation::NoClosedForm{
        "a contact of MuJoCo's pyramid slips, or lacks a row that another one has"};
  // With downhill = a first + b second, sideways is a second - b first, and the speed along each
  // tangent has the sign of a or b.
  const double speed = row * load.normal / (reference.damping * mu);
  const double downhill = pyramid->along * load.along + pyramid->across * load.across;
  const double sideways = pyramid->across * load.along - pyramid->along * load.across;
  return MujocoRest{{speed * downhill, load.turned < 0. ? -speed * sideways : speed * sideways},
                    pyramid->depth * row * load.normal / (reference.stiffness * d)};
}

}  // namespace

simulation::ClosedForm<MujocoRest> mujoco_rest(const MujocoLoad& load,
                                               const MujocoSettings& settings, const MujocoRow& row,
                                               double dt) {
  const contact::MujocoReference reference = contact::mujoco_reference(row, dt);
  const auto at = [&](double depth) {
    return rest_at(load, settings, reference, contact::mujoco_impedance(row, depth));
  };
  const auto surface = at(0.);
  if (!surface) return surface;
  // The impedance changes with depth one way, and the depth that carries the load the other way.
  const auto beyond = at(row.impedance[2]);
  const double deepest = std::max(surface->depth, beyond->depth);
  return at(bisect([&](double depth) { return depth - at(depth)->depth; }, 0., deepest));
}

}  // namespace hookpoint::reference
