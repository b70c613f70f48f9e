// A body's wrench without acceleration: pA = what its angular velocity takes, less what acts on it
// from outside.
#pragma once

#include "dts/rigid_body.h"
#include "dts/workspace.h"

namespace hookpoint::dts {

/// pA of a body that turns at `w` (body axes) under the wrench `external` (world axes).
template <class Real>
constexpr Wrench<Real> bias_wrench(const RigidInertia<Real>& inertia, const Vector3<Real>& w,
                                   const Matrix3<Real>& R_WB, const Wrench<Real>& external) {
  return velocity_wrench(inertia, w) - Wrench<Real>{transpose_times(R_WB, external.moment),
                                                    transpose_times(R_WB, external.force)};
}

/// pA of the links `n` of a group's chains.
template <class Real>
Wrench<Lanes<Real>> bias_wrench(const ChainGroup<Real>& group, std::size_t n,
                                const LinkPass<Lanes<Real>>& pass,
                                const Workspace<Real>& workspace) {
  const Wrench<Lanes<Real>> external = gather(at_body(group, n, std::span(workspace.external)));
  return bias_wrench(group.links[n].inertia, pass.w, pass.R_WB, external);
}

}  // namespace hookpoint::dts
