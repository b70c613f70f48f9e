// Accelerations from forces: the decoupled tree-structure recursion of Reichler & Delcomyn 2000,
// Fig. 3 (Freeman & Orin 1991), as articulated bodies (Featherstone 2008, chapter 7). O(chains *
// links a chain).
#pragma once

#include <span>

#include "dts/forward_kinematics.h"

namespace hookpoint::dts {

/// Accelerations at the state that forward_kinematics saw last, under `workspace.external`, the
/// joint torques (or, for prismatic joints, forces) `joint_torques` [N m or N, one a link] and
/// gravity `gravity_W` [m/s^2, world axes]. Sets base_acceleration, base_angular_acceleration,
/// joint_accelerations and hip_wrenches of the workspace.
template <class Real>
void forward_dynamics(const Model<Real>& model, const Vector3<Real>& gravity_W,
                      std::span<const std::type_identity_t<Real>> joint_torques,
                      Workspace<Real>& workspace);

/// All of Fig. 3's steps at `state`: forward_kinematics, then the above.
template <class Real>
void forward_dynamics(const Model<Real>& model, const State<Real>& state,
                      const Vector3<Real>& gravity_W,
                      std::span<const std::type_identity_t<Real>> joint_torques,
                      Workspace<Real>& workspace) {
  forward_kinematics(model, state, workspace);
  forward_dynamics(model, gravity_W, joint_torques, workspace);
}

extern template void forward_dynamics(const Model<double>&, const Vector3<double>&,
                                      std::span<const double>, Workspace<double>&);

}  // namespace hookpoint::dts
