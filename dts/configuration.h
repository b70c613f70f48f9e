// A robot's state as the integrators see it: positions on a manifold, velocities a vector.
// Generalised velocity: [w_WB (3), v_WB (3)] for a mobile base, then the joint rates, chain by
// chain; accelerations alike.
#pragma once

#include <span>

#include "dts/state.h"
#include "dts/workspace.h"

namespace hookpoint::dts {

/// Numbers that describe a configuration: position (3) and unit quaternion (4) of a mobile base,
/// joint positions.
template <class Real>
std::size_t position_count(const Model<Real>& model) {
  return (model.mobile() ? 7 : 0) + model.link_count();
}
/// Length of a generalised velocity.
template <class Real>
std::size_t velocity_count(const Model<Real>& model) {
  return (model.mobile() ? 6 : 0) + model.link_count();
}

/// A state with every number 0 and the base unrotated, of the model's size.
template <class Real>
State<Real> zero_state(const Model<Real>& model) {
  State<Real> state;
  state.joint_positions.resize(model.link_count());
  state.joint_rates.resize(model.link_count());
  return state;
}

/// Writes the base's part of a generalised velocity, acceleration or force.
template <class Real>
void write_base_velocity(const Vector3<Real>& angular, const Vector3<Real>& linear,
                         std::span<Real> velocity) {
  velocity[0] = angular.x;
  velocity[1] = angular.y;
  velocity[2] = angular.z;
  velocity[3] = linear.x;
  velocity[4] = linear.y;
  velocity[5] = linear.z;
}

/// Reads the generalised velocity of `state` into `velocity`.
template <class Real>
void get_velocity(const Model<Real>& model, const State<Real>& state, std::span<Real> velocity);

/// Writes the generalised velocity `velocity` into `state`.
template <class Real>
void set_velocity(const Model<Real>& model, std::span<const std::type_identity_t<Real>> velocity,
                  State<Real>& state);

/// The accelerations that forward_dynamics found, in the layout of a generalised velocity.
template <class Real>
void get_acceleration(const Model<Real>& model, const Workspace<Real>& workspace,
                      std::span<Real> acceleration);

/// Moves the positions of `from` by the generalised velocity `tangent` held for `dt` [s] and writes
/// them to `to` (whose velocities stay; `to` may be `from`): positions by v dt, the base's
/// orientation on its group by exp(w_WB dt) R_WB, renormalised.
template <class Real>
void retract(const Model<Real>& model, const State<Real>& from,
             std::span<const std::type_identity_t<Real>> tangent, const Real& dt, State<Real>& to);

extern template void get_velocity(const Model<double>&, const State<double>&, std::span<double>);
extern template void set_velocity(const Model<double>&, std::span<const double>, State<double>&);
extern template void get_acceleration(const Model<double>&, const Workspace<double>&,
                                      std::span<double>);
extern template void retract(const Model<double>&, const State<double>&, std::span<const double>,
                             const double&, State<double>&);

}  // namespace hookpoint::dts
