// Unit quaternions (w, x, y, z) and their exponential map. `R_AB` takes components in frame B to
// components in A.
#pragma once

#include "math/matrix3.h"

namespace hookpoint {

template <class Real>
struct Quaternion {
  Real w{1.}, x{}, y{}, z{};
  constexpr bool operator==(const Quaternion&) const = default;
};
using Quaterniond = Quaternion<double>;

template <class Real>
constexpr Quaternion<Real> operator*(const Quaternion<Real>& a, const Quaternion<Real>& b) {
  return {
      a.w * b.w - a.x * b.x - a.y * b.y - a.z * b.z, a.w * b.x + a.x * b.w + a.y * b.z - a.z * b.y,
      a.w * b.y - a.x * b.z + a.y * b.w + a.z * b.x, a.w * b.z + a.x * b.y - a.y * b.x + a.z * b.w};
}
template <class Real>
constexpr Quaternion<Real> conjugate(const Quaternion<Real>& q) {
  return {q.w, -q.x, -q.y, -q.z};
}
// Which products the compiler fuses into sums must not differ with the caller (not inlined) nor
// with `Real` (named).
template <class Real>
[[gnu::noinline]] Quaternion<Real> normalized(const Quaternion<Real>& q) {
  const Real ww = q.w * q.w, xx = q.x * q.x, yy = q.y * q.y, zz = q.z * q.z;
  const Real scale = 1. / sqrt(ww + xx + yy + zz);
  return {scale * q.w, scale * q.x, scale * q.y, scale * q.z};
}
/// The rotation matrix R_AB of the unit quaternion `q` = q_AB.
template <class Real>
constexpr Matrix3<Real> rotation_matrix(const Quaternion<Real>& q) {
  return {1. - 2. * (q.y * q.y + q.z * q.z), 2. * (q.x * q.y - q.w * q.z),
          2. * (q.x * q.z + q.w * q.y),      2. * (q.x * q.y + q.w * q.z),
          1. - 2. * (q.x * q.x + q.z * q.z), 2. * (q.y * q.z - q.w * q.x),
          2. * (q.x * q.z - q.w * q.y),      2. * (q.y * q.z + q.w * q.x),
          1. - 2. * (q.x * q.x + q.y * q.y)};
}
template <class Real>
constexpr Vector3<Real> rotate(const Quaternion<Real>& q, const Vector3<Real>& a) {
  const Vector3<Real> u{q.x, q.y, q.z};
  const Vector3<Real> t = 2. * cross(u, a);
  return a + q.w * t + cross(u, t);
}
/// exp of the rotation vector `u` [rad]: the rotation by |u| about u. Exact to rounding, also as
/// |u| -> 0.
template <class Real>
Quaternion<Real> exponential(const Vector3<Real>& u) {
  const Real squared = dot(u, u);
  const Real angle = sqrt(squared);
  const SineCosine<Real> half = sine_cosine(0.5 * angle);
  // sin(a/2)/a = 1/2 - a^2/48 + a^4/3840 - ...; below a^2 = 1e-8 the next term is under rounding.
  const Mask<Real> small = squared < Real(1e-8);
  const Real scale =
      select(small, 0.5 - squared * (1. / 48.), half.sine / select(small, Real(1.), angle));
  return {half.cosine, scale * u.x, scale * u.y, scale * u.z};
}
/// Rotation from roll, pitch, yaw [rad]: Rot_z(yaw) Rot_y(pitch) Rot_x(roll), about the fixed x,
/// then y, then z axes.
template <class Real>
Quaternion<Real> from_roll_pitch_yaw(const Real& roll, const Real& pitch, const Real& yaw) {
  return exponential(Vector3<Real>{0., 0., yaw}) * exponential(Vector3<Real>{0., pitch, 0.}) *
         exponential(Vector3<Real>{roll, 0., 0.});
}
template <class Real>
constexpr Quaternion<Real> select(const Mask<Real>& mask, const Quaternion<Real>& a,
                                  const Quaternion<Real>& b) {
  return {select(mask, a.w, b.w), select(mask, a.x, b.x), select(mask, a.y, b.y),
          select(mask, a.z, b.z)};
}
/// The unit quaternion of a rotation matrix (Shepperd's choice of the largest component: no
/// cancellation).
template <class Real>
Quaternion<Real> quaternion_from(const Matrix3<Real>& r) {
  const Real trace = r.xx + r.yy + r.zz;
  const Mask<Real> w_largest = trace >= r.xx && trace >= r.yy && trace >= r.zz;
  const Mask<Real> x_largest = r.xx >= r.yy && r.xx >= r.zz;
  const Mask<Real> y_largest = r.yy >= r.zz;
  const Quaternion<Real> by_w{1. + trace, r.zy - r.yz, r.xz - r.zx, r.yx - r.xy};
  const Quaternion<Real> by_x{r.zy - r.yz, 1. + r.xx - r.yy - r.zz, r.xy + r.yx, r.xz + r.zx};
  const Quaternion<Real> by_y{r.xz - r.zx, r.xy + r.yx, 1. - r.xx + r.yy - r.zz, r.yz + r.zy};
  const Quaternion<Real> by_z{r.yx - r.xy, r.xz + r.zx, r.yz + r.zy, 1. - r.xx - r.yy + r.zz};
  return normalized(
      select(w_largest, by_w, select(x_largest, by_x, select(y_largest, by_y, by_z))));
}
/// Of the two quaternions of the rotation `q` the one nearer to `last`, so that a record has no
/// jumps.
template <class Real>
Quaternion<Real> continued(const Quaternion<Real>& q, const Quaternion<Real>& last) {
  const Real cosine = q.w * last.w + q.x * last.x + q.y * last.y + q.z * last.z;
  return select(cosine < Real(0.), Quaternion<Real>{-q.w, -q.x, -q.y, -q.z}, q);
}

}  // namespace hookpoint
