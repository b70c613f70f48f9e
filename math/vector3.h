// Vectors of three components; the axes they are expressed in are part of a variable's name.
#pragma once

#include "math/scalar.h"

namespace hookpoint {

template <class Real>
struct Vector3 {
  Real x{}, y{}, z{};

  constexpr Vector3& operator+=(const Vector3& b) {
    x += b.x;
    y += b.y;
    z += b.z;
    return *this;
  }
  constexpr Vector3& operator-=(const Vector3& b) {
    x -= b.x;
    y -= b.y;
    z -= b.z;
    return *this;
  }
  constexpr bool operator==(const Vector3&) const = default;
};

using Vector3d = Vector3<double>;

template <class Real>
constexpr Vector3<Real> operator+(Vector3<Real> a, const Vector3<Real>& b) {
  return a += b;
}
template <class Real>
constexpr Vector3<Real> operator-(Vector3<Real> a, const Vector3<Real>& b) {
  return a -= b;
}
template <class Real>
constexpr Vector3<Real> operator-(const Vector3<Real>& a) {
  return {-a.x, -a.y, -a.z};
}
template <class Real>
constexpr Vector3<Real> operator*(std::type_identity_t<Real> s, const Vector3<Real>& a) {
  return {s * a.x, s * a.y, s * a.z};
}
template <class Real>
constexpr Real dot(const Vector3<Real>& a, const Vector3<Real>& b) {
  return a.x * b.x + a.y * b.y + a.z * b.z;
}
template <class Real>
constexpr Vector3<Real> cross(const Vector3<Real>& a, const Vector3<Real>& b) {
  return {a.y * b.z - a.z * b.y, a.z * b.x - a.x * b.z, a.x * b.y - a.y * b.x};
}
template <class Real>
Real norm(const Vector3<Real>& a) {
  return sqrt(dot(a, a));
}
/// `a` without its part along the unit vector `n`.
template <class Real>
constexpr Vector3<Real> tangential(const Vector3<Real>& a, const Vector3<Real>& n) {
  return a - dot(a, n) * n;
}
template <class Real>
constexpr Vector3<Real> select(const Mask<Real>& mask, const Vector3<Real>& a,
                               const Vector3<Real>& b) {
  return {select(mask, a.x, b.x), select(mask, a.y, b.y), select(mask, a.z, b.z)};
}

}  // namespace hookpoint
