// What the laws with a bristle share. A bristle is the tangential give of a contact as a continuous
// state z: the integrator moves it along with the motion, and the law gives its rate beside the
// force.
#pragma once

#include <limits>

#include "contact/predictions.h"
#include "contact/vocabulary.h"

namespace hookpoint::contact {

/// A law without a continuous state.
struct WithoutBristle {
  static constexpr std::size_t bristle_states = 0;  ///< numbers of Bristle that it integrates
  /// Height above the ground up to which the law acts [m].
  static double reach(const MaterialConstants<double>& /*material*/) { return 0.; }
  /// No bristle, so none that a step could fail to resolve [m/s].
  static double resolved_speed(double /*load*/, double /*dt*/,
                               const MaterialConstants<double>& /*material*/) {
    return std::numeric_limits<double>::infinity();
  }
};

/// A divisor: `value`, or 1 where that is not positive, for a quotient that is then not used or 0.
template <class Real>
Real positive_or_one(const Real& value) {
  return select(value > Real(0.), value, Real(1.));
}

/// The deflection z bent no farther than `limit` [N] >= 0 can hold: k_t |z| <= limit. What a
/// falling load no longer holds lets go.
template <class Real>
Vector3<Real> held_deflection(const Vector3<Real>& z, const MaterialConstants<Real>& material,
                              const Real& limit) {
  const Real force = material.tangential_stiffness * norm(z);
  return select(force > limit, (limit / positive_or_one(force)) * z, z);
}

/// Least relaxation time of a slipping bristle, which without damping or load would have none [s].
inline constexpr double shortest_relaxation = 1e-6;

/// Friction on the ground [N], the rate of the bristle [m/s], and whether it slips.
template <class Real>
struct BristleFriction {
  Vector3<Real> force, rate;
  Mask<Real> slips{};
};

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

/// The reaction of a point that the law reaches (`inside`), with deflection z and friction
/// `friction` (on the ground); nothing, and no memory, elsewhere. The hook is where the unbent
/// bristle would stand.
template <class Real>
Reaction<Real> bristle_reaction(const PointKinematics<Real>& point, const Mask<Real>& inside,
                                const Real& normal_force, const Vector3<Real>& z,
                                const BristleFriction<Real>& friction) {
  const Vector3<Real> zero{};
  Reaction<Real> reaction;
  reaction.force = select(inside, normal_force * point.normal - friction.force, zero);
  reaction.bristle.deflection = select(inside, z, zero);
  reaction.bristle_rate.deflection = select(inside, friction.rate, zero);
  reaction.next.hook = select(inside, point.position + point.depth * point.normal - z, zero);
  reaction.next.stretch = reaction.bristle.deflection;
  reaction.next.attached = inside;
  reaction.next.sliding = inside && friction.slips;
  return reaction;
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

/// The point as an accepted state goes on: with its bristle where the law holds it. Once a step.
template <class Law, class Real>
PointKinematics<Real> held_point(const Law& law, PointKinematics<Real> point,
                                 const Memory<Real>& memory,
                                 const MaterialConstants<Real>& material, const Real& dt) {
  if constexpr (Law::bristle_states > 0)
    point.bristle = law.evaluate(point, memory, material, dt).bristle;
  return point;
}

/// The reaction with which semi-implicit Euler advances velocities from a state: its positions have
/// already moved with the velocity of the state, and so must the bristle have that the force comes
/// from. Else the bristle is explicit Euler's, which pumps energy into a spring. The bristle's own
/// rate is that of the state. Two evaluations for a law with a bristle.
template <class Law, class Real>
Reaction<Real> semi_implicit_reaction(const Law& law, PointKinematics<Real> point,
                                      const Memory<Real>& memory,
                                      const MaterialConstants<Real>& material, const Real& dt) {
  Reaction<Real> reaction = law.evaluate(point, memory, material, dt);
  if constexpr (Law::bristle_states > 0) {
    point.bristle.deflection = reaction.bristle.deflection + dt * reaction.bristle_rate.deflection;
    point.bristle.sliding = reaction.bristle.sliding + dt * reaction.bristle_rate.sliding;
    const Reaction<Real> moved = law.evaluate(point, memory, material, dt);
    reaction.force = moved.force;
    reaction.next = moved.next;
  }
  return reaction;
}

}  // namespace hookpoint::contact
