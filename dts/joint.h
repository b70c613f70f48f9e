// One joint in the recursions: its free direction S, the z unit vector of angular (revolute) or of
// linear motion (prismatic), and the way across it and across a hip. Choices here are of the
// model's structure, never of the state.
#pragma once

#include "dts/mdh.h"
#include "dts/rigid_body.h"
#include "dts/workspace.h"

namespace hookpoint::dts {

/// S^T f.
template <class Real>
constexpr Real along(JointType joint, const Wrench<Real>& f) {
  return joint == JointType::revolute ? f.moment.z : f.force.z;
}
/// a + S x.
template <class Real>
constexpr Motion<Real> with_joint_motion(JointType joint, Motion<Real> a, const Real& x) {
  if (joint == JointType::revolute) {
    a.angular.z += x;
  } else {
    a.linear.z += x;
  }
  return a;
}

/// A - u u^T / D; the parts along S come out as rounding of zero, and are zero.
template <class Real>
constexpr Symmetric3<Real> less_dyad(const Symmetric3<Real>& A, const Vector3<Real>& u,
                                     const Vector3<Real>& u_over_D) {
  return {A.xx - u.x * u_over_D.x, A.yy - u.y * u_over_D.y, A.zz - u.z * u_over_D.z,
          A.xy - u.x * u_over_D.y, A.xz - u.x * u_over_D.z, A.yz - u.y * u_over_D.z};
}

/// U = IA S, D = S^T U, Ia = IA - U U^T / D (Featherstone 2008, equation 7.43). Along a revolute z,
/// row and column of I and the row of H vanish; along a prismatic z, row and column of M and the
/// column of H do.
template <class Real>
constexpr Elimination<Real> eliminate(JointType joint, const ArticulatedInertia<Real>& IA) {
  const auto& [I, H, M] = IA;
  if (joint == JointType::revolute) {
    const Vector3<Real> m{I.xz, I.yz, I.zz};
    const Vector3<Real> f{H.zx, H.zy, H.zz};
    const Real D_inverse = 1. / I.zz;
    const Real mx = D_inverse * m.x;
    const Real my = D_inverse * m.y;
    return {{{I.xx - mx * m.x, I.yy - my * m.y, 0., I.xy - mx * m.y, 0., 0.},
             {H.xx - mx * f.x, H.xy - mx * f.y, H.xz - mx * f.z, H.yx - my * f.x, H.yy - my * f.y,
              H.yz - my * f.z, 0., 0., 0.},
             less_dyad(M, f, D_inverse * f)},
            {m, f},
            D_inverse};
  }
  const Vector3<Real> m{H.xz, H.yz, H.zz};
  const Vector3<Real> f{M.xz, M.yz, M.zz};
  const Real D_inverse = 1. / M.zz;
  const Real fx = D_inverse * f.x;
  const Real fy = D_inverse * f.y;
  return {{less_dyad(I, m, D_inverse * m),
           {H.xx - m.x * fx, H.xy - m.x * fy, 0., H.yx - m.y * fx, H.yy - m.y * fy, 0.,
            H.zx - m.z * fx, H.zy - m.z * fy, 0.},
           {M.xx - fx * f.x, M.yy - fy * f.y, 0., M.xy - fx * f.y, 0., 0.}},
          {m, f},
          D_inverse};
}

/// U = IA S.
template <class Real>
constexpr Wrench<Real> column(JointType joint, const ArticulatedInertia<Real>& IA) {
  const auto& [I, H, M] = IA;
  if (joint == JointType::revolute) return {{I.xz, I.yz, I.zz}, {H.zx, H.zy, H.zz}};
  return {{H.xz, H.yz, H.zz}, {M.xz, M.yz, M.zz}};
}

/// The same where nothing vanishes: of a joint whose motor and gears turn with it, D = S^T U + I_r
/// (Featherstone 2008, section 9.6; of a rotor the spin alone). Not inlined, for the sake of joints
/// whose zeros the recursions know.
template <class Real>
[[gnu::noinline]] constexpr Elimination<Real> eliminate_fully(const LinkConstants<Real>& link,
                                                              const ArticulatedInertia<Real>& IA) {
  const auto& [I, H, M] = IA;
  const Wrench<Real> U = column(link.joint, IA);
  const auto& [m, f] = U;
  const Real D_inverse = 1. / (along(link.joint, U) + link.rotor_inertia);
  const Vector3<Real> n = D_inverse * m;
  return {
      {less_dyad(I, m, n),
       {H.xx - n.x * f.x, H.xy - n.x * f.y, H.xz - n.x * f.z, H.yx - n.y * f.x, H.yy - n.y * f.y,
        H.yz - n.y * f.z, H.zx - n.z * f.x, H.zy - n.z * f.y, H.zz - n.z * f.z},
       less_dyad(M, f, D_inverse * f)},
      U,
      D_inverse};
}

// Across a placement, inwards and outwards. Not inlined: few robots have one, and the recursions of
// the others are a sixth slower with this code in their midst (docs/urdf.md).
template <class Real>
[[gnu::noinline]] constexpr ArticulatedInertia<Real> inward(const Placement<Real>& at,
                                                            const ArticulatedInertia<Real>& A) {
  return shift(at.shift, rotate_z(at.sine, at.cosine, A));
}
template <class Real>
[[gnu::noinline]] constexpr Wrench<Real> inward(const Placement<Real>& at, const Wrench<Real>& f) {
  const Vector3<Real> force = rotate_z(at.sine, at.cosine, f.force);
  return {rotate_z(at.sine, at.cosine, f.moment) + cross(at.shift, force), force};
}
template <class Real>
[[gnu::noinline]] constexpr Motion<Real> outward(const Placement<Real>& at, const Motion<Real>& a) {
  return {rotate_z(-at.sine, at.cosine, a.angular),
          rotate_z(-at.sine, at.cosine, a.linear + cross(a.angular, at.shift))};
}

/// An inertia or a wrench of a link, as the frame ahead of its screws sees it.
template <class Real, class Quantity>
constexpr Quantity inward_screws(const LinkConstants<Real>& link, const LinkPass<Real>& pass,
                                 const Quantity& x) {
  const Quantity y = inward_z(pass.turn, x);
  return link.twisted ? inward_x(link.twist, y) : y;
}
/// A motion of the frame ahead of a link's screws, as the link would have it with its joint locked.
template <class Real>
constexpr Motion<Real> outward_screws(const LinkConstants<Real>& link, const LinkPass<Real>& pass,
                                      const Motion<Real>& a) {
  return outward_z(pass.turn, link.twisted ? outward_x(link.twist, a) : a);
}

/// An inertia or a wrench of a link, as the preceding link sees it.
template <class Real, class Quantity>
constexpr Quantity inward(const LinkConstants<Real>& link, const LinkPass<Real>& pass,
                          const Quantity& x) {
  const Quantity y = inward_screws(link, pass, x);
  return link.placed ? inward(link.placement, y) : y;
}
/// A motion of the preceding link, as the link would have it with its joint locked.
template <class Real>
constexpr Motion<Real> outward(const LinkConstants<Real>& link, const LinkPass<Real>& pass,
                               const Motion<Real>& a) {
  return outward_screws(link, pass, link.placed ? outward(link.placement, a) : a);
}

/// Inertias of chains about their hips, as the carriers see them: H' = H + [p]x M, I' = I - H [p]x
/// + [p]x H'^T.
template <class Real>
constexpr ArticulatedInertia<Lanes<Real>> inward(const ChainGroup<Real>& group,
                                                 const ArticulatedInertia<Lanes<Real>>& x) {
  const auto& [p_BH, R_BH, hip_to_H] = group.hip;
  if (group.aligned) return shift(p_BH, x);
  return shift(p_BH, {congruent(R_BH, x.I), R_BH * x.H * transpose(R_BH), congruent(R_BH, x.M)});
}
template <class Real>
constexpr Wrench<Lanes<Real>> inward(const ChainGroup<Real>& group, const Wrench<Lanes<Real>>& f) {
  const auto& [p_BH, R_BH, hip_to_H] = group.hip;
  const Vector3<Lanes<Real>> force = R_BH * f.force;
  return {R_BH * f.moment + cross(p_BH, force), force};
}
/// The carriers' motion as the hips have it.
template <class Real>
constexpr Motion<Lanes<Real>> outward(const ChainGroup<Real>& group, const Motion<Lanes<Real>>& a) {
  const auto& [p_BH, R_BH, hip_to_H] = group.hip;
  return {transpose_times(R_BH, a.angular),
          transpose_times(R_BH, a.linear + cross(a.angular, p_BH))};
}

}  // namespace hookpoint::dts
