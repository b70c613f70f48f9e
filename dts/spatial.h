// Spatial quantities of a body, about its frame's origin and in its axes, angular part first.
// Accelerations are classical (of the origin, d/dt of its velocity), so the recursions need angular
// velocities only (docs/performance.md).
#pragma once

#include "math/matrix3.h"

namespace hookpoint::dts {

/// A velocity, an acceleration or a change of velocity: angular [rad/s..] and, at the origin,
/// linear [m/s..].
template <class Real>
struct Motion {
  Vector3<Real> angular, linear;
};

/// A moment about the origin [N m] and a force [N]; or, for impacts, their time integrals.
template <class Real>
struct Wrench {
  Vector3<Real> moment, force;
};

/// [I H; H^T M], what relates a body's acceleration to the wrench on it when everything it carries
/// moves along (Featherstone 2008, section 7.1). A rigid body has H = [m c]x and M = m 1.
template <class Real>
struct ArticulatedInertia {
  Symmetric3<Real> I;
  Matrix3<Real> H;
  Symmetric3<Real> M;
};

template <class Real>
constexpr Motion<Real> operator+(const Motion<Real>& a, const Motion<Real>& b) {
  return {a.angular + b.angular, a.linear + b.linear};
}
template <class Real>
constexpr Wrench<Real> operator+(const Wrench<Real>& a, const Wrench<Real>& b) {
  return {a.moment + b.moment, a.force + b.force};
}
template <class Real>
constexpr Wrench<Real> operator-(const Wrench<Real>& a, const Wrench<Real>& b) {
  return {a.moment - b.moment, a.force - b.force};
}
template <class Real>
constexpr Wrench<Real> operator-(const Wrench<Real>& a) {
  return {-a.moment, -a.force};
}
template <class Real>
constexpr Wrench<Real> operator*(std::type_identity_t<Real> s, const Wrench<Real>& a) {
  return {s * a.moment, s * a.force};
}
template <class Real>
constexpr Real dot(const Wrench<Real>& f, const Motion<Real>& a) {
  return dot(f.moment, a.angular) + dot(f.force, a.linear);
}

template <class Real>
constexpr ArticulatedInertia<Real> operator+(const ArticulatedInertia<Real>& a,
                                             const ArticulatedInertia<Real>& b) {
  return {a.I + b.I, a.H + b.H, a.M + b.M};
}
template <class Real>
constexpr Wrench<Real> operator*(const ArticulatedInertia<Real>& IA, const Motion<Real>& a) {
  return {IA.I * a.angular + IA.H * a.linear, transpose_times(IA.H, a.angular) + IA.M * a.linear};
}

}  // namespace hookpoint::dts
