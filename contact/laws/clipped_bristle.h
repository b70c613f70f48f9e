// A bristle that is a spring-damper to a massless foot which slips at the friction cone (Azad &
// Featherstone 2010), and stick-slip friction with it. The limit of a dragged hook, too, as dt -> 0
// (hookpoint.h).
#pragma once

#include "contact/laws/bristle.h"

namespace hookpoint::contact {

/// `friction`, cut to the length `limit` where it is longer [N].
template <class Real>
Vector3<Real> clipped(const Vector3<Real>& friction, const Real& limit) {
  const Real magnitude = norm(friction);
  return select(magnitude > limit, (limit / positive_or_one(magnitude)) * friction, friction);
}

/// The damper through which the foot of a clipped bristle slips [N s/m]: c_t, and no less than what
/// lets u relax in a step `dt` [s], nor than in `shortest_relaxation`.
template <class Real>
Real slip_damping(const MaterialConstants<Real>& material, const Real& dt) {
  return max(material.tangential_damping,
             max(dt, Real(shortest_relaxation)) * material.tangential_stiffness);
}

/// What a foot that holds would feel through that damper, f* = k_t u + r v [N]: it slips where
/// this is beyond the cone.
template <class Real>
Vector3<Real> slip_trial(const Vector3<Real>& u, const Vector3<Real>& v,
                         const MaterialConstants<Real>& material, const Real& dt) {
  return material.tangential_stiffness * u + slip_damping(material, dt) * v;
}

/// A bristle that is a spring-damper to a massless foot which slips at the cone (Azad &
/// Featherstone 2010): with r the slip_damping and the trial f* = k_t u + r v of a foot that holds,
///   stick  |f*| <= mu N:  f = k_t u + c_t v, no more than mu N,   u' = v
///   slip   otherwise:     f = mu N f*/|f*|,                       u' = (f - k_t u)/r
/// where r = c_t, f = k_t u + c_t u' in both. The same r in the trial and in the relaxation keeps
/// friction from giving what was not stored, whatever c_t, dt and mu N, which may change:
///   slip   f.v - k_t u.u' = mu N (|f*| - mu N)/r + r u'^2 >= 0
///   stick  f.v - k_t u.u' = c_t v^2, or (1 - s) (-k_t u.v) + s c_t v^2 where f is cut by s < 1:
///          then |k_t u + c_t v| > mu N >= |k_t u + r v| with c_t < r, hence u.v < 0.
/// `limit` = mu N [N].
template <class Real>
BristleFriction<Real> clipped_bristle(const PointKinematics<Real>& point, const Vector3<Real>& u,
                                      const MaterialConstants<Real>& material, const Real& limit,
                                      const Real& dt) {
  const Vector3<Real> v = tangential(point.velocity, point.normal);
  const Vector3<Real> trial = slip_trial(u, v, material, dt);
  const Real magnitude = norm(trial);
  const Vector3<Real> spring = material.tangential_stiffness * u;
  BristleFriction<Real> friction;
  friction.slips = magnitude > limit;
  const Vector3<Real> slip_force = (limit / positive_or_one(magnitude)) * trial;
  const Vector3<Real> slip_rate =
      (1. / positive_or_one(slip_damping(material, dt))) * (slip_force - spring);
  friction.force = select(friction.slips, slip_force,
                          clipped(Vector3<Real>(spring + material.tangential_damping * v), limit));
  friction.rate = select(friction.slips, slip_rate, v);
  return friction;
}

/// Sliding speed up to which a step dt [s] resolves a clipped bristle: any if its relaxation time
/// c_t/k_t is at least dt, else none [m/s].
inline double clipped_bristle_resolved(double dt, const MaterialConstants<double>& material) {
  return material.tangential_damping >= dt * material.tangential_stiffness
             ? std::numeric_limits<double>::infinity()
             : 0.;
}

/// The reaction of a point with normal force `normal_force` N [N] and a clipped bristle: mu is mu_s
/// while it sticks, and mu_k from a slip on until the trial falls below mu_k N.
template <class Real>
Reaction<Real> stick_slip_reaction(const PointKinematics<Real>& point, const Memory<Real>& memory,
                                   const MaterialConstants<Real>& material, const Real& dt,
                                   const Real& normal_force) {
  const Mask<Real> inside = point.depth > Real(0.);
  const Mask<Real> sliding = inside && memory.attached && memory.sliding;
  const Real mu = select(sliding, material.kinetic_friction, material.static_friction);
  const Vector3<Real> u = tangential(point.bristle.deflection, point.normal);
  const BristleFriction<Real> friction =
      clipped_bristle(point, u, material, Real(mu * normal_force), dt);
  return bristle_reaction(point, inside, normal_force, u, friction);
}

/// Whether a slip meets less friction than a break-away.
inline bool friction_falls(const Constants& material) {
  return material.static_friction > material.kinetic_friction;
}

/// What is left of the friction before the trial of an attached point is beyond it, mu N - |f*|
/// [N], with mu as in stick_slip_reaction: positive while the point sticks, negative while it
/// slips. `normal_force` N [N].
inline double friction_left(const PointKinematics<double>& point, const Memory<double>& memory,
                            const Constants& material, double normal_force) {
  const double mu = memory.sliding ? material.kinetic_friction : material.static_friction;
  const Vector3d trial = slip_trial(tangential(point.bristle.deflection, point.normal),
                                    tangential(point.velocity, point.normal), material, 0.);
  return mu * normal_force - norm(trial);
}

/// The switching value of a law with stick_slip_reaction: if friction falls at break-away, the
/// friction left, which is 0 where the point breaks away and where it comes to stick again; else
/// friction is continuous there, and only a reversal of slip is an event.
inline double stick_slip_switching_value(const PointKinematics<double>& point,
                                         const Memory<double>& memory, const Constants& material,
                                         double normal_force) {
  return friction_falls(material) ? friction_left(point, memory, material, normal_force)
                                  : slip_reversal(point, memory);
}

/// Whether the point slides on after that event: where friction falls, if its friction has run out.
inline bool stick_slip_slides_after(bool falling, const Memory<double>& memory,
                                    const Constants& material) {
  return friction_falls(material) ? falling : memory.sliding;
}

}  // namespace hookpoint::contact
