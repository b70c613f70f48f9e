#include "reference/mujoco/contact_at_rest.h"

#include <algorithm>
#include <cmath>
#include <optional>

#include "contact/bisect.h"
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

/// R of each of a pyramid's rows, of that of an elliptic normal row.
double pyramid_softness(double friction, const MujocoSettings& settings, double softness) {
  const double mu_squared = friction * friction;
  return 2. * mu_squared / settings.friction_impedance * (1. + mu_squared) * softness;
}

/// At impedance `d`.
simulation::ClosedForm<MujocoRest> rest_at(const MujocoLoad& load, const MujocoSettings& settings,
                                           const MujocoReference& reference, double d) {
  const double softness = (1. - d) / d * load.inverse_weight;
  const double mu = load.friction;
  if (settings.elliptic) {
    if (load.tangential > mu * load.least * load.normal) return point_at_limit;
    return MujocoRest{
        {softness / settings.friction_impedance * load.tangential / reference.damping, 0.},
        softness * load.normal / (reference.stiffness * d)};
  }
  const double row = pyramid_softness(mu, settings, softness);
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

MujocoReference mujoco_reference(const MujocoRow& row, double dt) {
  const double d =
      std::clamp(row.impedance[1], mujoco_least_impedance, 1. - mujoco_least_impedance);
  if (row.reference[0] < 0.) return {-row.reference[0] / (d * d), -row.reference[1] / d};
  const double time = std::max(row.reference[0], 2. * dt) * d;
  return {1. / (time * time * row.reference[1] * row.reference[1]), 2. / time};
}

double mujoco_impedance(const MujocoRow& row, double depth) {
  const auto [at_surface, at_width, width, midpoint, power] = row.impedance;
  const auto bounded = [](double d) {
    return std::clamp(d, mujoco_least_impedance, 1. - mujoco_least_impedance);
  };
  if (at_surface == at_width || width <= 0.) return bounded(at_surface);
  const double x = std::min(1., depth / width);
  const double y = x <= midpoint
                       ? midpoint * std::pow(x / midpoint, power)
                       : 1. - (1. - midpoint) * std::pow((1. - x) / (1. - midpoint), power);
  return bounded(at_surface + y * (at_width - at_surface));
}

double mujoco_normal_softness(double inverse_weight, double friction,
                              const MujocoSettings& settings, double d) {
  const double softness = (1. - d) / d * inverse_weight;
  return settings.elliptic ? softness : 0.25 * pyramid_softness(friction, settings, softness);
}

simulation::ClosedForm<MujocoRest> mujoco_rest(const MujocoLoad& load,
                                               const MujocoSettings& settings, const MujocoRow& row,
                                               double dt) {
  const MujocoReference reference = mujoco_reference(row, dt);
  const auto at = [&](double depth) {
    return rest_at(load, settings, reference, mujoco_impedance(row, depth));
  };
  const auto surface = at(0.);
  if (!surface) return surface;
  // The impedance changes with depth one way, and the depth that carries the load the other way.
  const auto beyond = at(row.impedance[2]);
  const double deepest = std::max(surface->depth, beyond->depth);
  return at(contact::bisect([&](double depth) { return depth - at(depth)->depth; }, 0., deepest));
}

}  // namespace hookpoint::reference
