// A body's wrench without acceleration: pA = what its angular velocity takes, less what acts on it
// from outside.
#pragma once

#include "dts/rigid_body.h"
#include "dts/workspace.h"

namespace hookpoint::dts {

/// pA of `body`, which turns at `w` (body axes).
template <class Real>
Wrench<Real> bias_wrench(const RigidInertia<Real>& inertia, const Vector3<Real>& w,
                         std::size_t body, const Workspace<Real>& workspace) {
  const Matrix3<Real>& R_WB = workspace.bodies[body].R_WB;
  const Wrench<Real>& external = workspace.external[body];
  return velocity_wrench(inertia, w) - Wrench<Real>{transpose_times(R_WB, external.moment),
                                                    transpose_times(R_WB, external.force)};
}

}  // namespace hookpoint::dts
