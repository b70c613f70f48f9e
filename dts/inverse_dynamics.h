// Forces from accelerations: recursive Newton-Euler (Featherstone 2008, section 5.3) in link
// frames.
#pragma once

#include <span>

#include "dts/workspace.h"

namespace hookpoint::dts {

/// What moves a robot: accelerations of the base origin (world axes) and of the joints.
template <class Real>
struct Accelerations {
  Vector3<Real> base_angular;    ///< [rad/s^2]; a fixed base has 0
  Vector3<Real> base_linear;     ///< classical, of the base origin [m/s^2]
  std::span<const Real> joints;  ///< one a link
};

/// Joint torques `joint_torques` [N m or N, one a link, written] that give the robot the
/// accelerations `accelerations` under `workspace.external` and gravity, at the state that
/// forward_kinematics saw last. Returns the further wrench on the base (about its origin, world
/// axes) that this takes: for a fixed base, what its support exerts (less the base's own weight);
/// for a mobile one it is 0 when the accelerations are those of free motion. O(links).
/// `workspace.link_wrenches` serves as scratch.
template <class Real>
Wrench<Real> inverse_dynamics(const Model<Real>& model, const Vector3<Real>& gravity_W,
                              const Accelerations<Real>& accelerations,
                              std::span<Real> joint_torques, Workspace<Real>& workspace);

extern template Wrench<double> inverse_dynamics(const Model<double>&, const Vector3<double>&,
                                                const Accelerations<double>&, std::span<double>,
                                                Workspace<double>&);

}  // namespace hookpoint::dts
