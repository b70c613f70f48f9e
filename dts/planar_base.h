// A mobile base that is kept in a plane of world axes: of its six velocities three are held at 0.
// The constraint S x = a with S the three free directions turns a = -IA^-1 pA into
// a = -S (S^T IA S)^-1 S^T pA (Featherstone 2008, section 3.2); of that inverse each block is again
// symmetric, so that hip_forces.h solves a planar base as a free one.
#pragma once

#include <cstddef>

#include "dts/spatial.h"
#include "dts/workspace.h"

namespace hookpoint::dts {

/// Whether velocity `k` of a base (0-2 angular, 3-5 linear, world axes) is held where its plane has
/// the normal `normal`: 0, 1, 2 for x, y, z.
constexpr bool held_in_plane(std::size_t k, std::size_t normal) {
  return k < 3 ? k != normal : k - 3 == normal;
}

/// The world axis `axis`, in the axes of a body that is turned by R_WB.
template <class Real>
Vector3<Real> world_axis_in(const Matrix3<Real>& R_WB, std::size_t axis) {
  if (axis == 0) return {R_WB.xx, R_WB.xy, R_WB.xz};
  if (axis == 1) return {R_WB.yx, R_WB.yy, R_WB.yz};
  return {R_WB.zx, R_WB.zy, R_WB.zz};
}

/// Sets what the plane holds to 0 exactly: a sum of rotated parts leaves rounding.
template <class Real>
void hold_in_plane(const Model<Real>& model, Vector3<Real>& angular, Vector3<Real>& linear) {
  if (!model.plane_normal()) return;
  Real* const parts[] = {&angular.x, &angular.y, &angular.z, &linear.x, &linear.y, &linear.z};
  for (std::size_t k = 0; k < 6; ++k)
    if (held_in_plane(k, *model.plane_normal())) *parts[k] = 0.;
}

/// s v v^T.
template <class Real>
Symmetric3<Real> outer_square(const Real& s, const Vector3<Real>& v) {
  return {s * v.x * v.x, s * v.y * v.y, s * v.z * v.z, s * v.x * v.y, s * v.x * v.z, s * v.y * v.z};
}

/// Restricts the factors of a free base to the plane with the normal `n` (base axes): the inverse
/// of M within it, E (E^T M E)^-1 E^T = M^-1 - (M^-1 n)(M^-1 n)^T / n^T M^-1 n, and a turn about n
/// alone, n n^T / n^T (I - H M^-1 H^T) n.
template <class Real>
void restrict_to_plane(const Vector3<Real>& n, const Symmetric3<Real>& I, BasePass<Real>& base) {
  const Vector3<Real> across = base.M_inverse * n;
  base.M_inverse = base.M_inverse - outer_square<Real>(1. / dot(n, across), across);
  const Symmetric3<Real> turning = I - congruent(base.H, base.M_inverse);
  base.rotational_inverse = outer_square<Real>(1. / dot(n, turning * n), n);
}

}  // namespace hookpoint::dts
