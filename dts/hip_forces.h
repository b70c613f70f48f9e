// Step 3 of Fig. 3 of Reichler & Delcomyn 2000: the hips' forces on the base, and the base's
// acceleration from them.
#pragma once

#include "dts/workspace.h"

namespace hookpoint::dts {

/// Sets `workspace.base_motion`, the base's acceleration less gravity `gravity_W` [m/s^2] (base
/// axes), and from it base_acceleration and base_angular_acceleration (world axes). O(chains).
template <class Real>
void hip_forces_to_base(const Model<Real>& model, const Vector3<Real>& gravity_W,
                        Workspace<Real>& workspace);

/// Gathers and factors the inertia of the base with all that it carries (nothing to do for a fixed
/// base).
template <class Real>
void factor_base(const Model<Real>& model, Workspace<Real>& workspace);

/// a = -IA^-1 pA with the factors of `factor_base`: two symmetric 3x3 inverses by the Schur
/// complement of M; of a planar base within its plane (planar_base.h).
template <class Real>
Motion<Real> solve_base(const BasePass<Real>& base, const Wrench<Real>& pA) {
  const Vector3<Real> angular =
      base.rotational_inverse * (base.H * (base.M_inverse * pA.force) - pA.moment);
  return {angular, -(base.M_inverse * (pA.force + transpose_times(base.H, angular)))};
}

/// w x (w x p): the acceleration of hips that the carriers' angular velocity alone gives them, in
/// their axes.
template <class Real>
Vector3<Lanes<Real>> hip_centripetal(const ChainGroup<Real>& group,
                                     const Workspace<Real>& workspace) {
  const Vector3<Lanes<Real>>& w = workspace.carrier_w[group.index];
  return transpose_times(group.hip.R_BH, cross(w, cross(w, group.hip.p_BH)));
}

/// What a group's chains ask of their hips while the carriers turn on without acceleration.
template <class Real>
Wrench<Lanes<Real>> wrench_on_hip(const ChainGroup<Real>& group, const Workspace<Real>& workspace) {
  const auto& [IA, pA] = workspace.hips[group.index];
  const Vector3<Lanes<Real>> c = hip_centripetal(group, workspace);
  return pA + Wrench<Lanes<Real>>{IA.H * c, IA.M * c};
}

extern template void hip_forces_to_base(const Model<double>&, const Vector3<double>&,
                                        Workspace<double>&);
extern template void factor_base(const Model<double>&, Workspace<double>&);

}  // namespace hookpoint::dts
