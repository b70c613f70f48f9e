// A rigid body's equations of motion about its frame's origin, body axes, classical acceleration of
// that origin:
//   moment = I dw + h x a + w x I w,   force = m a + dw x h + w x (w x h),   h = m c.
#pragma once

#include "dts/model.h"

namespace hookpoint::dts {

/// The body alone, nothing articulated: H = [h]x, M = m 1.
template <class Real>
constexpr ArticulatedInertia<Real> articulated(const RigidInertia<Real>& body) {
  const Real& m = body.mass;
  return {body.inertia, cross_matrix(body.mass_moment), {m, m, m, 0., 0., 0.}};
}

/// `carried` and the body itself, taken together.
template <class Real>
constexpr ArticulatedInertia<Real> operator+(const ArticulatedInertia<Real>& carried,
                                             const RigidInertia<Real>& body) {
  ArticulatedInertia<Real> A = carried;
  const Vector3<Real>& h = body.mass_moment;
  A.I += body.inertia;
  A.H.xy -= h.z;
  A.H.xz += h.y;
  A.H.yx += h.z;
  A.H.yz -= h.x;
  A.H.zx -= h.y;
  A.H.zy += h.x;
  A.M.xx += body.mass;
  A.M.yy += body.mass;
  A.M.zz += body.mass;
  return A;
}

/// What the acceleration `a` takes.
template <class Real>
constexpr Wrench<Real> operator*(const RigidInertia<Real>& body, const Motion<Real>& a) {
  return {body.inertia * a.angular + cross(body.mass_moment, a.linear),
          body.mass * a.linear + cross(a.angular, body.mass_moment)};
}

/// What the angular velocity `w` alone takes.
template <class Real>
constexpr Wrench<Real> velocity_wrench(const RigidInertia<Real>& body, const Vector3<Real>& w) {
  return {cross(w, body.inertia * w), cross(w, cross(w, body.mass_moment))};
}

}  // namespace hookpoint::dts
