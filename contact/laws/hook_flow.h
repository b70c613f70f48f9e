// The laws with a hook as differential equations: what they become as dt -> 0, for an integrator
// that chooses its own steps. A hook that is moved once a step makes a saw that no tolerance takes
// away; here its stretch e moves along with the motion, as a bristle.
#pragma once

#include "contact/laws/bristle.h"

namespace hookpoint::contact {

/// The return map's limit. e = (mu_k N t + (c_t/dt) e_old)/(k_t + c_t/dt) is backward Euler on
///   c_t e' = mu_k N t - k_t e,
/// the slip of a clipped bristle, and a hook that stays is e' = v.
template <class Law>
struct ReturnFlow : Law {
  static constexpr std::size_t bristle_states = 3;

  /// Force on the robot, bristle rate and next memory of one point with Law's normal force;
  /// friction by stick_slip_reaction. O(1), pure, no branch on state.
  template <class Real>
  static Reaction<Real> evaluate(const PointKinematics<Real>& point, const Memory<Real>& memory,
                                 const MaterialConstants<Real>& material, const Real& dt) {
    const Real depth_rate = -dot(point.velocity, point.normal);
    return stick_slip_reaction(point, memory, material, dt,
                               Law::normal_force(point.depth, depth_rate, material));
  }
};

/// Least stretch from which a hook is thrown [m], far below any that matters: where the damper
/// alone is at the cone's edge the saw of a thrown hook has infinitely many teeth.
inline constexpr double least_thrown_stretch = 1e-9;

/// The thrown hook's limit: what sticks does so until |f*| = mu_s N, when its hook is thrown to the
/// foot (an event); from there it slips, e = 0 and f = mu_k N v/|v|, while the damper leaves the
/// spring less than the least stretch, c_t |v| + k_t e_least > mu_k N, else it sticks again.
template <class Law>
struct ThrowFlow : Law {
  static constexpr std::size_t bristle_states = 3;

  /// As ReturnFlow::evaluate. The memory says whether the point slips; one that sticks and is found
  /// beyond the cone is at its event, or a trial state past it, which goes on smoothly.
  template <class Real>
  static Reaction<Real> evaluate(const PointKinematics<Real>& point, const Memory<Real>& memory,
                                 const MaterialConstants<Real>& material, const Real& /*dt*/) {
    const Vector3<Real> zero{}, v = tangential(point.velocity, point.normal);
    const Vector3<Real> e = tangential(point.bristle.deflection, point.normal);
    const Real depth_rate = -dot(point.velocity, point.normal);
    const Real N = Law::normal_force(point.depth, depth_rate, material);
    const Mask<Real> inside = point.depth > Real(0.);
    const Mask<Real> sliding = inside && memory.attached && memory.sliding;
    const Real mu = select(sliding, material.kinetic_friction, material.static_friction);

    const Vector3<Real> trial = material.tangential_stiffness * e + material.tangential_damping * v;
    const Vector3<Real> kinetic = (material.kinetic_friction * N / positive_or_one(norm(v))) * v;
    const Real nearly = norm(trial) + material.tangential_stiffness * Real(least_thrown_stretch);
    const Mask<Real> thrown = nearly > mu * N;
    const Mask<Real> bent = norm(e) > Real(0.);
    BristleFriction<Real> friction;
    friction.slips = select(bent, Real(0.), nearly) > mu * N;
    friction.force = select(sliding, kinetic, select(friction.slips, kinetic, trial));
    friction.rate = select(sliding, zero, v);
    return bristle_reaction(point, inside, N, select(thrown, zero, e), friction);
  }
};

/// What is left of the friction before the trial is beyond it, mu N - |f*| [N]; of a point that
/// slips less than 0.
template <class Law>
double friction_left(const PointKinematics<double>& point, const Memory<double>& memory,
                     const MaterialConstants<double>& material) {
  const double N = Law::normal_force(point.depth, -dot(point.velocity, point.normal), material);
  const double mu = memory.sliding ? material.kinetic_friction : material.static_friction;
  const Vector3d trial = slip_trial(tangential(point.bristle.deflection, point.normal),
                                    tangential(point.velocity, point.normal), material, 0.);
  return mu * N - norm(trial);
}

/// Whether a slip meets less friction than a break-away.
inline bool friction_falls(const MaterialConstants<double>& material) {
  return material.static_friction > material.kinetic_friction;
}

/// Changes sign where the slip of a point reverses: v.z, z the bristle of the moment, 1 where it
/// sticks. Not the stretch that was committed last, which may be 0 and would keep the value at 0,
/// where no root finder gets away from it.
inline double slip_reversal(const PointKinematics<double>& point, const Memory<double>& memory) {
  return memory.sliding ? dot(point.velocity, tangential(point.bristle.deflection, point.normal))
                        : 1.;
}

/// A number that changes sign where an attached point has to be looked at before its motion goes
/// on, `memory` being committed: where slip reverses it sticks, and an integrator that stepped
/// across would go on pushing.
template <class Law>
double switching_value(const Law& /*law*/, const PointKinematics<double>& point,
                       const Memory<double>& memory,
                       const MaterialConstants<double>& /*material*/) {
  if constexpr (Law::bristle_states == 0) {
    return 1.;
  } else {
    return slip_reversal(point, memory);
  }
}

/// If friction falls as a point breaks away: where it does, and where it comes to stick again.
template <class Law>
double switching_value(const ReturnFlow<Law>& /*law*/, const PointKinematics<double>& point,
                       const Memory<double>& memory, const MaterialConstants<double>& material) {
  return friction_falls(material) ? friction_left<Law>(point, memory, material)
                                  : slip_reversal(point, memory);
}

/// Where the hook is thrown, and where a slipping point comes to stick.
template <class Law>
double switching_value(const ThrowFlow<Law>& /*law*/, const PointKinematics<double>& point,
                       const Memory<double>& memory, const MaterialConstants<double>& material) {
  const double least = material.tangential_stiffness * least_thrown_stretch;
  return friction_left<Law>(point, memory, material) - (memory.sliding ? least : 0.);
}

/// Whether a point slides on after the event at which its switching value has become negative
/// (`falling`) or positive. The state of the event is on the border of both, and rounding would
/// decide; the direction in which it was crossed tells. `memory` is what the law made of that
/// state.
template <class Law>
bool slides_after(const Law& /*law*/, bool /*falling*/, const Memory<double>& memory,
                  const MaterialConstants<double>& /*material*/) {
  return memory.sliding;
}
template <class Law>
bool slides_after(const ReturnFlow<Law>& /*law*/, bool falling, const Memory<double>& memory,
                  const MaterialConstants<double>& material) {
  return friction_falls(material) ? falling : memory.sliding;
}

}  // namespace hookpoint::contact
