// What an impulse does to the velocities: the recursion of forward dynamics with impulses in place
// of forces (Mirtich 1996, section 4.2.3; Featherstone 2008, section 11.7). Each response is
// O(links between the base and the two bodies).
//
// Order of calls: forward_kinematics, then articulated_inertias or forward_dynamics (either leaves
// the articulated inertias of the present configuration in the workspace), then any number of
// responses.
#pragma once

#include <span>

#include "dts/state.h"
#include "dts/workspace.h"

namespace hookpoint::dts {

/// The inertia half of the backward recursion, all that impulses need.
template <class Real>
void articulated_inertias(const Model<Real>& model, Workspace<Real>& workspace);

/// A point that moves with a body.
template <class Real>
struct BodyPoint {
  std::size_t body = 0;
  Vector3<Real> p_WP;  ///< where it is now, world axes [m]
};

/// J_B M^-1 J_A^T [1/kg], world axes: the velocity change of `b` per unit impulse at `a`.
template <class Real>
Matrix3<Real> impulse_response(const Model<Real>& model, Workspace<Real>& workspace,
                               const BodyPoint<Real>& a, const BodyPoint<Real>& b);

/// The collision matrix K = J M^-1 J^T [1/kg] of a point, world axes; symmetric.
template <class Real>
Matrix3<Real> collision_matrix(const Model<Real>& model, Workspace<Real>& workspace,
                               const BodyPoint<Real>& point) {
  return impulse_response(model, workspace, point, point);
}

/// M^-1 J^T P: how the impulse `impulse_W` [N s, world axes] at `point` changes the generalised
/// velocity, written to `change` in the layout of configuration.h ([w_WB, v_WB] for a mobile base,
/// then joint rates). O(links).
template <class Real>
void velocity_change(const Model<Real>& model, Workspace<Real>& workspace,
                     const BodyPoint<Real>& point, const Vector3<Real>& impulse_W,
                     std::span<Real> change);

/// M^-1 e_j p: the same of an impulse p [N m s, N s] that the drive of link `link`'s joint gives,
/// against the body that carries it. O(links).
template <class Real>
void velocity_change_by_joint(const Model<Real>& model, Workspace<Real>& workspace,
                              std::size_t link, const Real& impulse, std::span<Real> change);

/// Adds the velocity change of an impulse at a point to the state.
template <class Real>
void apply_impulse(const Model<Real>& model, Workspace<Real>& workspace,
                   const BodyPoint<Real>& point, const Vector3<Real>& impulse_W,
                   State<Real>& state);

extern template void articulated_inertias(const Model<double>&, Workspace<double>&);
extern template Matrix3<double> impulse_response(const Model<double>&, Workspace<double>&,
                                                 const BodyPoint<double>&,
                                                 const BodyPoint<double>&);
extern template void velocity_change(const Model<double>&, Workspace<double>&,
                                     const BodyPoint<double>&, const Vector3<double>&,
                                     std::span<double>);
extern template void velocity_change_by_joint(const Model<double>&, Workspace<double>&, std::size_t,
                                              const double&, std::span<double>);
extern template void apply_impulse(const Model<double>&, Workspace<double>&,
                                   const BodyPoint<double>&, const Vector3<double>&,
                                   State<double>&);

}  // namespace hookpoint::dts
