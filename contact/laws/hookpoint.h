// The paper's law: a spring-damper hooked to the ground where the point came in, with the hook
// dragged along by return mapping when friction is exceeded (Reichler & Delcomyn 2000, 3.3; return
// mapping as in plasticity, Simo & Hughes 1998).
#pragma once

#include "contact/laws/clipped_bristle.h"
#include "contact/laws/spring_damper.h"

namespace hookpoint::contact {

/// The reaction of a point with normal force `normal_force` N [N] and a hook that slip drags along:
///   stick  |f*| <= mu N:  f = f*,         h stays
///   slip   otherwise:     f = mu_k N t,   e = (mu_k N t + (c_t/dt) e_old)/(k_t + c_t/dt)
/// so that f = k_t e + c_t (e - e_old)/dt also holds while slipping. Where the damper alone would
/// pull (N = 0) the slip line reads e' = -(k_t/c_t) e: no friction, and the stretch relaxes. `dt`
/// [s] is the step of the commit. Needs k_t > 0 and dt > 0. O(1), pure, no branch on state.
template <class Real>
Reaction<Real> return_mapped_reaction(const PointKinematics<Real>& point,
                                      const Memory<Real>& memory,
                                      const MaterialConstants<Real>& material, const Real& dt,
                                      const Real& normal_force) {
  const HookTrial<Real> trial = hook_trial(point, memory, material, dt);
  const Mask<Real> slips = trial_slips(trial, normal_force, material);

  const Vector3<Real> kinetic = kinetic_friction_force(trial, normal_force, material);
  const Vector3<Real> friction = select(slips, kinetic, trial.force);

  const Real damping_rate = material.tangential_damping / dt;
  const Vector3<Real> mapped = (1. / (material.tangential_stiffness + damping_rate)) *
                               (kinetic + damping_rate * trial.old_stretch);
  const Vector3<Real> stretch = select(slips, mapped, trial.stretch);
  const Vector3<Real> hook = select(slips, trial.surface - mapped, trial.hook);
  return hook_reaction(point, trial, normal_force, friction, stretch, hook, slips);
}

/// A law with return_mapped_reaction as dt -> 0. The map of a slip is backward Euler on
///   c_t e' = mu_k N t - k_t e,
/// the slip of a clipped bristle, and a hook that stays is e' = v. A hook moved once a step makes a
/// saw that no tolerance of an integrator takes away; here its stretch e is the bristle.
template <class Law>
struct ReturnMapRateForm : Law {
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

  static double switching_value(const PointKinematics<double>& point, const Memory<double>& memory,
                                const Constants& material) {
    const double depth_rate = -dot(point.velocity, point.normal);
    return stick_slip_switching_value(point, memory, material,
                                      Law::normal_force(point.depth, depth_rate, material));
  }
  static bool slides_after(bool falling, const Memory<double>& memory, const Constants& material) {
    return stick_slip_slides_after(falling, memory, material);
  }
};

struct Hookpoint : SpringDamperPredictions {
  static constexpr const char* name = "hookpoint";
  static constexpr const char* source = "Reichler & Delcomyn 2000, 3.3";
  static constexpr const char* summary =
      "linear spring-damper; tangential spring to a hook that slip drags along (return mapping)";
  static constexpr ConstantList constants{
      &Constants::normal_stiffness,   &Constants::normal_damping,  &Constants::tangential_stiffness,
      &Constants::tangential_damping, &Constants::static_friction, &Constants::kinetic_friction};
  static constexpr ConstantList own_constants{};
  using RateForm = ReturnMapRateForm<Hookpoint>;

  /// Force on the robot and next memory of one point: N = max(0, k d + c d'), friction by
  /// return_mapped_reaction, whose needs are this law's.
  template <class Real>
  static Reaction<Real> evaluate(const PointKinematics<Real>& point, const Memory<Real>& memory,
                                 const MaterialConstants<Real>& material, const Real& dt) {
    return return_mapped_reaction(
        point, memory, material, dt,
        normal_force(point.depth, Real(-dot(point.velocity, point.normal)), material));
  }
};

}  // namespace hookpoint::contact
