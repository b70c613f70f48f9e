#include "contact/mujoco_contact.h"

#include <algorithm>
#include <cmath>

#include "math/bisect.h"

namespace hookpoint::contact {
namespace {

double bounded(double impedance) {
  return std::clamp(impedance, mujoco_least_impedance, 1. - mujoco_least_impedance);
}

/// (1 - d)/d A.
double softness_at(double d, double inverse_weight) { return (1. - d) / d * inverse_weight; }

}  // namespace

bool is_mujoco_reference(const std::array<double, 2>& reference) {
  return reference[0] < 0. ? reference[1] <= 0. : reference[0] > 0. && reference[1] > 0.;
}

MujocoReference mujoco_reference(const MujocoRow& row, double dt) {
  const double d = bounded(row.impedance[1]);
  if (row.reference[0] <= 0.) return {-row.reference[0] / (d * d), -row.reference[1] / d};
  const double time = std::max(row.reference[0], 2. * dt) * d;
  return {1. / (time * time * row.reference[1] * row.reference[1]), 2. / time};
}

double mujoco_impedance(const MujocoRow& row, double depth) {
  // MuJoCo clamps what is out of range.
  const double at_surface = bounded(row.impedance[0]), at_width = bounded(row.impedance[1]);
  const double width = row.impedance[2], midpoint = bounded(row.impedance[3]);
  const double power = std::max(1., row.impedance[4]);
  if (at_surface == at_width || width <= 0.) return 0.5 * (at_surface + at_width);
  const double x = std::min(1., depth / width);
  const double y = x <= midpoint
                       ? midpoint * std::pow(x / midpoint, power)
                       : 1. - (1. - midpoint) * std::pow((1. - x) / (1. - midpoint), power);
  return at_surface + y * (at_width - at_surface);
}

double mujoco_pyramid_softness(double coefficient, const MujocoFriction& friction,
                               double softness) {
  const double mu_squared = coefficient * coefficient;
  return 2. * mu_squared / friction.impedance_ratio * (1. + mu_squared) * softness;
}

double mujoco_normal_softness(double inverse_weight, double coefficient,
                              const MujocoFriction& friction, double d) {
  const double softness = softness_at(d, inverse_weight);
  if (friction.elliptic) return softness;
  return 0.25 * mujoco_pyramid_softness(coefficient, friction, softness);
}

MujocoRow mujoco_mixed(const MujocoRow& a, const MujocoRow& b) {
  MujocoRow mixed;
  const bool standard = a.reference[0] > 0. && b.reference[0] > 0.;
  for (std::size_t i = 0; i < mixed.reference.size(); ++i)
    mixed.reference[i] = standard ? 0.5 * (a.reference[i] + b.reference[i])
                                  : std::min(a.reference[i], b.reference[i]);
  for (std::size_t i = 0; i < mixed.impedance.size(); ++i)
    mixed.impedance[i] = 0.5 * (a.impedance[i] + b.impedance[i]);
  return mixed;
}

MujocoSpring mujoco_spring(const MujocoRow& row, const MujocoFriction& friction,
                           const MujocoLoading& at) {
  // Without friction a contact has its normal row alone.
  MujocoFriction rows = friction;
  rows.elliptic = friction.elliptic || at.coefficient < mujoco_least_friction;
  const MujocoReference reference = mujoco_reference(row, at.dt);
  const auto softness = [&](double depth) {
    return mujoco_normal_softness(at.inverse_weight, at.coefficient, rows,
                                  mujoco_impedance(row, depth));
  };
  const auto depth_of = [&](double depth) {
    return softness(depth) * at.load / (reference.stiffness * mujoco_impedance(row, depth));
  };
  // The impedance changes one way, and so does the depth that carries the load.
  const double deepest = std::max(depth_of(0.), depth_of(row.impedance[2]));
  MujocoSpring spring{};
  spring.depth = bisect([&](double depth) { return depth - depth_of(depth); }, 0., deepest);
  spring.stiffness = at.load / spring.depth;
  spring.damping_ratio = reference.damping /
                         (2. * std::sqrt(reference.stiffness * mujoco_impedance(row, spring.depth) *
                                         (1. + at.mass * softness(spring.depth))));
  spring.damping = 2. * spring.damping_ratio * std::sqrt(spring.stiffness * at.mass);
  return spring;
}

double mujoco_creep(const MujocoRow& row, const MujocoFriction& friction, const MujocoLoading& at,
                    double depth, double angle) {
  const double softness = softness_at(mujoco_impedance(row, depth), at.inverse_weight);
  const double mu_squared = at.coefficient * at.coefficient;
  return (friction.elliptic ? 1. : 1. + mu_squared) * softness / friction.impedance_ratio *
         at.load * std::sin(angle) / mujoco_reference(row, at.dt).damping;
}

}  // namespace hookpoint::contact
