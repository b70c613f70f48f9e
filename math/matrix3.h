// General and symmetric 3x3 matrices. A symmetric one stores six numbers, which is what lets the
// articulated-body recursion move 21 numbers a link instead of 36 (docs/performance.md).
#pragma once

#include "math/vector3.h"

namespace hookpoint {

template <class Real>
struct Matrix3 {
  Real xx{}, xy{}, xz{}, yx{}, yy{}, yz{}, zx{}, zy{}, zz{};

  static constexpr Matrix3 identity() { return {1., 0., 0., 0., 1., 0., 0., 0., 1.}; }
  constexpr bool operator==(const Matrix3&) const = default;
};
using Matrix3d = Matrix3<double>;

template <class Real>
struct Symmetric3 {
  Real xx{}, yy{}, zz{}, xy{}, xz{}, yz{};

  constexpr Symmetric3& operator+=(const Symmetric3& b) {
    xx += b.xx;
    yy += b.yy;
    zz += b.zz;
    xy += b.xy;
    xz += b.xz;
    yz += b.yz;
    return *this;
  }
  constexpr bool operator==(const Symmetric3&) const = default;
};
using Symmetric3d = Symmetric3<double>;

template <class Real>
constexpr Vector3<Real> operator*(const Matrix3<Real>& m, const Vector3<Real>& a) {
  return {m.xx * a.x + m.xy * a.y + m.xz * a.z, m.yx * a.x + m.yy * a.y + m.yz * a.z,
          m.zx * a.x + m.zy * a.y + m.zz * a.z};
}
/// Transpose of `m` times `a`, without forming the transpose.
template <class Real>
constexpr Vector3<Real> transpose_times(const Matrix3<Real>& m, const Vector3<Real>& a) {
  return {m.xx * a.x + m.yx * a.y + m.zx * a.z, m.xy * a.x + m.yy * a.y + m.zy * a.z,
          m.xz * a.x + m.yz * a.y + m.zz * a.z};
}
template <class Real>
constexpr Matrix3<Real> operator*(const Matrix3<Real>& a, const Matrix3<Real>& b) {
  return {a.xx * b.xx + a.xy * b.yx + a.xz * b.zx, a.xx * b.xy + a.xy * b.yy + a.xz * b.zy,
          a.xx * b.xz + a.xy * b.yz + a.xz * b.zz, a.yx * b.xx + a.yy * b.yx + a.yz * b.zx,
          a.yx * b.xy + a.yy * b.yy + a.yz * b.zy, a.yx * b.xz + a.yy * b.yz + a.yz * b.zz,
          a.zx * b.xx + a.zy * b.yx + a.zz * b.zx, a.zx * b.xy + a.zy * b.yy + a.zz * b.zy,
          a.zx * b.xz + a.zy * b.yz + a.zz * b.zz};
}
template <class Real>
constexpr Matrix3<Real> transpose(const Matrix3<Real>& m) {
  return {m.xx, m.yx, m.zx, m.xy, m.yy, m.zy, m.xz, m.yz, m.zz};
}
template <class Real>
constexpr Matrix3<Real> operator+(const Matrix3<Real>& a, const Matrix3<Real>& b) {
  return {a.xx + b.xx, a.xy + b.xy, a.xz + b.xz, a.yx + b.yx, a.yy + b.yy,
          a.yz + b.yz, a.zx + b.zx, a.zy + b.zy, a.zz + b.zz};
}
template <class Real>
constexpr Matrix3<Real> operator-(const Matrix3<Real>& a, const Matrix3<Real>& b) {
  return {a.xx - b.xx, a.xy - b.xy, a.xz - b.xz, a.yx - b.yx, a.yy - b.yy,
          a.yz - b.yz, a.zx - b.zx, a.zy - b.zy, a.zz - b.zz};
}
template <class Real>
constexpr Matrix3<Real> operator*(std::type_identity_t<Real> s, const Matrix3<Real>& m) {
  return {s * m.xx, s * m.xy, s * m.xz, s * m.yx, s * m.yy, s * m.yz, s * m.zx, s * m.zy, s * m.zz};
}
/// The matrix of `a x .`.
template <class Real>
constexpr Matrix3<Real> cross_matrix(const Vector3<Real>& a) {
  return {0., -a.z, a.y, a.z, 0., -a.x, -a.y, a.x, 0.};
}
template <class Real>
constexpr Real determinant(const Matrix3<Real>& m) {
  return m.xx * (m.yy * m.zz - m.yz * m.zy) - m.xy * (m.yx * m.zz - m.yz * m.zx) +
         m.xz * (m.yx * m.zy - m.yy * m.zx);
}
/// Inverse by cofactors; the caller knows that `m` is regular.
template <class Real>
constexpr Matrix3<Real> inverse(const Matrix3<Real>& m) {
  return (1. / determinant(m)) * Matrix3<Real>{m.yy * m.zz - m.yz * m.zy, m.xz * m.zy - m.xy * m.zz,
                                               m.xy * m.yz - m.xz * m.yy, m.yz * m.zx - m.yx * m.zz,
                                               m.xx * m.zz - m.xz * m.zx, m.xz * m.yx - m.xx * m.yz,
                                               m.yx * m.zy - m.yy * m.zx, m.xy * m.zx - m.xx * m.zy,
                                               m.xx * m.yy - m.xy * m.yx};
}

template <class Real>
constexpr Vector3<Real> operator*(const Symmetric3<Real>& m, const Vector3<Real>& a) {
  return {m.xx * a.x + m.xy * a.y + m.xz * a.z, m.xy * a.x + m.yy * a.y + m.yz * a.z,
          m.xz * a.x + m.yz * a.y + m.zz * a.z};
}
template <class Real>
constexpr Symmetric3<Real> operator+(Symmetric3<Real> a, const Symmetric3<Real>& b) {
  return a += b;
}
template <class Real>
constexpr Symmetric3<Real> operator-(const Symmetric3<Real>& a, const Symmetric3<Real>& b) {
  return {a.xx - b.xx, a.yy - b.yy, a.zz - b.zz, a.xy - b.xy, a.xz - b.xz, a.yz - b.yz};
}
template <class Real>
constexpr Symmetric3<Real> operator*(std::type_identity_t<Real> s, const Symmetric3<Real>& m) {
  return {s * m.xx, s * m.yy, s * m.zz, s * m.xy, s * m.xz, s * m.yz};
}
template <class Real>
constexpr Matrix3<Real> general(const Symmetric3<Real>& m) {
  return {m.xx, m.xy, m.xz, m.xy, m.yy, m.yz, m.xz, m.yz, m.zz};
}
/// The symmetric part of `m`; exact when `m` is symmetric up to rounding.
template <class Real>
constexpr Symmetric3<Real> symmetric_part(const Matrix3<Real>& m) {
  return {m.xx, m.yy, m.zz, 0.5 * (m.xy + m.yx), 0.5 * (m.xz + m.zx), 0.5 * (m.yz + m.zy)};
}
/// Inverse by cofactors, one division; the caller knows that `m` is regular.
template <class Real>
constexpr Symmetric3<Real> inverse(const Symmetric3<Real>& m) {
  const Real cxx = m.yy * m.zz - m.yz * m.yz;
  const Real cxy = m.xz * m.yz - m.xy * m.zz;
  const Real cxz = m.xy * m.yz - m.xz * m.yy;
  const Real scale = 1. / (m.xx * cxx + m.xy * cxy + m.xz * cxz);
  return {scale * cxx,
          scale * (m.xx * m.zz - m.xz * m.xz),
          scale * (m.xx * m.yy - m.xy * m.xy),
          scale * cxy,
          scale * cxz,
          scale * (m.xy * m.xz - m.xx * m.yz)};
}
/// A M A^T, of which only six numbers are computed.
template <class Real>
constexpr Symmetric3<Real> congruent(const Matrix3<Real>& a, const Symmetric3<Real>& m) {
  const Vector3<Real> x{a.xx, a.xy, a.xz}, y{a.yx, a.yy, a.yz}, z{a.zx, a.zy, a.zz};
  const Vector3<Real> mx = m * x, my = m * y, mz = m * z;
  return {dot(x, mx), dot(y, my), dot(z, mz), dot(x, my), dot(x, mz), dot(y, mz)};
}
/// R M R^T: `m` re-expressed by the rotation `r`.
template <class Real>
constexpr Symmetric3<Real> rotate(const Matrix3<Real>& r, const Symmetric3<Real>& m) {
  return symmetric_part(r * general(m) * transpose(r));
}
/// mass (|c|^2 1 - c c^T): what a point mass at `c` adds to an inertia about the origin (Steiner).
template <class Real>
constexpr Symmetric3<Real> point_inertia(const Real& mass, const Vector3<Real>& c) {
  return mass * Symmetric3<Real>{c.y * c.y + c.z * c.z,
                                 c.x * c.x + c.z * c.z,
                                 c.x * c.x + c.y * c.y,
                                 -c.x * c.y,
                                 -c.x * c.z,
                                 -c.y * c.z};
}

}  // namespace hookpoint
