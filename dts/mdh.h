// Transforms across a joint in modified Denavit-Hartenberg form, Rot_x(alpha) Trans_x(a)
// Rot_z(theta) Trans_z(d): a screw about x from the preceding frame p to an intermediate frame y,
// then a screw about z to the link's frame i (Lilly 1993). A screw about x is a screw about z with
// the axes renamed cyclically, and is written so.
#pragma once

#include "dts/spatial.h"

namespace hookpoint::dts {

/// A rotation about an axis by an angle, and a shift along it [m].
template <class Real>
struct Screw {
  Real sine{}, cosine{}, shift{};
};

/// Components after renaming x, y, z to z, x, y: what was along x is then along z.
template <class Real>
constexpr Vector3<Real> x_to_z(const Vector3<Real>& a) {
  return {a.y, a.z, a.x};
}
template <class Real>
constexpr Symmetric3<Real> x_to_z(const Symmetric3<Real>& m) {
  return {m.yy, m.zz, m.xx, m.yz, m.xy, m.xz};
}
template <class Real>
constexpr Matrix3<Real> x_to_z(const Matrix3<Real>& m) {
  return {m.yy, m.yz, m.yx, m.zy, m.zz, m.zx, m.xy, m.xz, m.xx};
}
template <class Real>
constexpr Vector3<Real> z_to_x(const Vector3<Real>& a) {
  return {a.z, a.x, a.y};
}
template <class Real>
constexpr Symmetric3<Real> z_to_x(const Symmetric3<Real>& m) {
  return {m.zz, m.xx, m.yy, m.xz, m.yz, m.xy};
}
template <class Real>
constexpr Matrix3<Real> z_to_x(const Matrix3<Real>& m) {
  return {m.zz, m.zx, m.zy, m.xz, m.xx, m.xy, m.yz, m.yx, m.yy};
}

/// Rot_z a.
template <class Real>
constexpr Vector3<Real> rotate_z(const Real& sine, const Real& cosine, const Vector3<Real>& a) {
  return {cosine * a.x - sine * a.y, sine * a.x + cosine * a.y, a.z};
}
/// Rot_x a.
template <class Real>
constexpr Vector3<Real> rotate_x(const Real& sine, const Real& cosine, const Vector3<Real>& a) {
  return z_to_x(rotate_z(sine, cosine, x_to_z(a)));
}
/// R Rot_z: the rows of R turned back.
template <class Real>
constexpr Matrix3<Real> times_rotation_z(const Matrix3<Real>& r, const Real& sine,
                                         const Real& cosine) {
  return {cosine * r.xx + sine * r.xy, cosine * r.xy - sine * r.xx, r.xz,
          cosine * r.yx + sine * r.yy, cosine * r.yy - sine * r.yx, r.yz,
          cosine * r.zx + sine * r.zy, cosine * r.zy - sine * r.zx, r.zz};
}
/// R Rot_x.
template <class Real>
constexpr Matrix3<Real> times_rotation_x(const Matrix3<Real>& r, const Real& sine,
                                         const Real& cosine) {
  return z_to_x(times_rotation_z(x_to_z(r), sine, cosine));
}

/// Rot_z M Rot_z^T. The xy block keeps its trace and its antisymmetric part.
template <class Real>
constexpr Symmetric3<Real> rotate_z(const Real& sine, const Real& cosine,
                                    const Symmetric3<Real>& m) {
  const Real ss = sine * sine;
  const Real sc = sine * cosine;
  const Real difference = m.xx - m.yy;
  const Real sum = m.xy + m.xy;
  const Real k = ss * difference + sc * sum;
  return {m.xx - k,
          m.yy + k,
          m.zz,
          m.xy + (sc * difference - ss * sum),
          cosine * m.xz - sine * m.yz,
          sine * m.xz + cosine * m.yz};
}
template <class Real>
constexpr Matrix3<Real> rotate_z(const Real& sine, const Real& cosine, const Matrix3<Real>& m) {
  const Real ss = sine * sine;
  const Real sc = sine * cosine;
  const Real difference = m.xx - m.yy;
  const Real sum = m.xy + m.yx;
  const Real k = ss * difference + sc * sum;
  const Real l = sc * difference - ss * sum;
  return {m.xx - k,
          m.xy + l,
          cosine * m.xz - sine * m.yz,
          m.yx + l,
          m.yy + k,
          sine * m.xz + cosine * m.yz,
          cosine * m.zx - sine * m.zy,
          sine * m.zx + cosine * m.zy,
          m.zz};
}

/// R A R^T of all blocks, R = Rot_z.
template <class Real>
constexpr ArticulatedInertia<Real> rotate_z(const Real& sine, const Real& cosine,
                                            const ArticulatedInertia<Real>& A) {
  return {rotate_z(sine, cosine, A.I), rotate_z(sine, cosine, A.H), rotate_z(sine, cosine, A.M)};
}

/// About an origin `shift` further back along z: H' = H + [r]x M, I' = I - H [r]x + [r]x H'^T with
/// r = shift z.
template <class Real>
constexpr ArticulatedInertia<Real> shift_z(const Real& shift, const ArticulatedInertia<Real>& A) {
  const Matrix3<Real>& H = A.H;
  const Symmetric3<Real>& M = A.M;
  const Matrix3<Real> S{H.xx - shift * M.xy,
                        H.xy - shift * M.yy,
                        H.xz - shift * M.yz,
                        H.yx + shift * M.xx,
                        H.yy + shift * M.xy,
                        H.yz + shift * M.xz,
                        H.zx,
                        H.zy,
                        H.zz};
  return {{A.I.xx - shift * (H.xy + S.xy), A.I.yy + shift * (H.yx + S.yx), A.I.zz,
           A.I.xy + shift * (H.xx - S.yy), A.I.xz - shift * H.zy, A.I.yz + shift * H.zx},
          S,
          M};
}

/// About an origin further back by any `p`.
template <class Real>
constexpr ArticulatedInertia<Real> shift(const Vector3<Real>& p,
                                         const ArticulatedInertia<Real>& A) {
  const Matrix3<Real>& H = A.H;
  const Symmetric3<Real>& M = A.M;
  const Matrix3<Real> S{H.xx + p.y * M.xz - p.z * M.xy, H.xy + p.y * M.yz - p.z * M.yy,
                        H.xz + p.y * M.zz - p.z * M.yz, H.yx + p.z * M.xx - p.x * M.xz,
                        H.yy + p.z * M.xy - p.x * M.yz, H.yz + p.z * M.xz - p.x * M.zz,
                        H.zx + p.x * M.xy - p.y * M.xx, H.zy + p.x * M.yy - p.y * M.xy,
                        H.zz + p.x * M.yz - p.y * M.xz};
  return {{A.I.xx + p.y * (H.xz + S.xz) - p.z * (H.xy + S.xy),
           A.I.yy + p.z * (H.yx + S.yx) - p.x * (H.yz + S.yz),
           A.I.zz + p.x * (H.zy + S.zy) - p.y * (H.zx + S.zx),
           A.I.xy + p.z * H.xx - p.x * H.xz + p.y * S.yz - p.z * S.yy,
           A.I.xz + p.x * H.xy - p.y * H.xx + p.y * S.zz - p.z * S.zy,
           A.I.yz + p.x * H.yy - p.y * H.yx + p.z * S.zx - p.x * S.zz},
          S,
          M};
}

// From the link outwards of a screw about z to the frame before it ("inward") and back ("outward").
template <class Real>
constexpr ArticulatedInertia<Real> inward_z(const Screw<Real>& s,
                                            const ArticulatedInertia<Real>& A) {
  return shift_z(s.shift, rotate_z(s.sine, s.cosine, A));
}
template <class Real>
constexpr ArticulatedInertia<Real> inward_x(const Screw<Real>& s,
                                            const ArticulatedInertia<Real>& A) {
  const ArticulatedInertia<Real> B = inward_z(s, {x_to_z(A.I), x_to_z(A.H), x_to_z(A.M)});
  return {z_to_x(B.I), z_to_x(B.H), z_to_x(B.M)};
}
template <class Real>
constexpr Wrench<Real> inward_z(const Screw<Real>& s, const Wrench<Real>& f) {
  const Vector3<Real> force = rotate_z(s.sine, s.cosine, f.force);
  const Vector3<Real> moment = rotate_z(s.sine, s.cosine, f.moment);
  return {{moment.x - s.shift * force.y, moment.y + s.shift * force.x, moment.z}, force};
}
template <class Real>
constexpr Wrench<Real> inward_x(const Screw<Real>& s, const Wrench<Real>& f) {
  const Wrench<Real> g = inward_z(s, {x_to_z(f.moment), x_to_z(f.force)});
  return {z_to_x(g.moment), z_to_x(g.force)};
}
template <class Real>
constexpr Motion<Real> outward_z(const Screw<Real>& s, const Motion<Real>& a) {
  const Vector3<Real> linear{a.linear.x + s.shift * a.angular.y, a.linear.y - s.shift * a.angular.x,
                             a.linear.z};
  return {rotate_z(-s.sine, s.cosine, a.angular), rotate_z(-s.sine, s.cosine, linear)};
}
template <class Real>
constexpr Motion<Real> outward_x(const Screw<Real>& s, const Motion<Real>& a) {
  const Motion<Real> b = outward_z(s, {x_to_z(a.angular), x_to_z(a.linear)});
  return {z_to_x(b.angular), z_to_x(b.linear)};
}

}  // namespace hookpoint::dts
