// The rotation's part of a System's retract and tangent_rate, for orientations moved by rotation
// vectors in world axes.
#pragma once

#include "math/rotation.h"

namespace hookpoint::integrators {

/// exp(u) q0: orientation `q0` turned by the rotation vector `u` [rad, world axes], unit to
/// rounding.
template <class Real>
Quaternion<Real> rotation_retract(const Quaternion<Real>& q0, const Vector3<Real>& u) {
  return normalized(exponential(u) * q0);
}

/// du/dt such that exp(u(t)) q0 turns with angular velocity `w` [rad/s, world axes]:
///   dexp_u^-1 w = w - u x w/2 + (1 - (x/2) cot(x/2))/x^2 u x (u x w),  x = |u| < 2 pi
/// (Iserles, Munthe-Kaas, Norsett & Zanna 2000, Lie-group methods, App. B).
template <class Real>
Vector3<Real> rotation_tangent_rate(const Vector3<Real>& u, const Vector3<Real>& w) {
  const Real squared = dot(u, u);
  const Mask<Real> small = squared < Real(1e-4);
  const Real angle = sqrt(select(small, Real(1.), squared));
  const SineCosine<Real> half = sine_cosine(0.5 * angle);
  // (1 - (x/2) cot(x/2))/x^2 = 1/12 + x^2/720 + x^4/30240 + ...; at x^2 < 1e-4 the next term is
  // under rounding.
  const Real series = 1. / 12. + squared * (1. / 720. + squared * (1. / 30240.));
  const Real closed = (1. - 0.5 * angle * half.cosine / half.sine) / (angle * angle);
  const Vector3<Real> u_w = cross(u, w);
  return w - 0.5 * u_w + select(small, series, closed) * cross(u, u_w);
}

}  // namespace hookpoint::integrators
