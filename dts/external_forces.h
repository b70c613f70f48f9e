// External wrenches on bodies, gathered about each body's origin in world axes. Needs
// forward_kinematics first.
#pragma once

#include "dts/workspace.h"

namespace hookpoint::dts {

template <class Real>
void clear_external_forces(Workspace<Real>& workspace) {
  for (Wrench<Real>& wrench : workspace.external) wrench = {};
}

/// Adds the force `force_W` [N, world axes] acting on `body` at the world point `point_W` [m].
template <class Real>
void add_external_force(Workspace<Real>& workspace, std::size_t body, const Vector3<Real>& force_W,
                        const Vector3<Real>& point_W) {
  Wrench<Real>& wrench = workspace.external[body];
  wrench.force += force_W;
  wrench.moment += cross(point_W - workspace.bodies[body].p_WB, force_W);
}

/// Adds the pure torque `torque_W` [N m, world axes] on `body`.
template <class Real>
void add_external_torque(Workspace<Real>& workspace, std::size_t body,
                         const Vector3<Real>& torque_W) {
  workspace.external[body].moment += torque_W;
}

}  // namespace hookpoint::dts
