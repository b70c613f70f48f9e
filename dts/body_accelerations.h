// How every body accelerates under given accelerations of the base and the joints.
#pragma once

#include <span>

#include "dts/state.h"
#include "dts/workspace.h"

namespace hookpoint::dts {

/// Writes to `bodies`, one a body, the acceleration of each body's origin [m/s^2] and its angular
/// acceleration [rad/s^2], world axes, gravity included, at the state that forward_kinematics saw
/// last (`state`) and the accelerations that forward_dynamics left in the workspace:
///   alpha' = alpha + z ddq + w x z dq,   a' = a + alpha x r + w x (w x r)     revolute
///   alpha' = alpha,   a' = a + alpha x r + w x (w x r) + z ddq + 2 w x z dq   prismatic
/// with r from the preceding body's origin. O(links). Source: Featherstone 2008, section 5.3.
template <class Real>
void body_accelerations(const Model<Real>& model, const State<Real>& state,
                        const Workspace<Real>& workspace, std::span<Motion<Real>> bodies);

extern template void body_accelerations(const Model<double>&, const State<double>&,
                                        const Workspace<double>&, std::span<Motion<double>>);

}  // namespace hookpoint::dts
