// The paper's law: a spring-damper hooked to the ground where the point came in, with the hook
// dragged along by return mapping when friction is exceeded (Reichler & Delcomyn 2000, 3.3; return
// mapping as in plasticity, Simo & Hughes 1998).
#pragma once

#include "contact/spring_damper.h"

namespace hookpoint::contact {

struct Hookpoint : SpringDamperPredictions {
  static constexpr const char* name = "hookpoint";
  static constexpr const char* source = "Reichler & Delcomyn 2000, 3.3";
  static constexpr const char* summary =
      "linear spring-damper; tangential spring to a hook that slip drags along (return mapping)";

  /// Force on the robot and next memory of one point.
  ///   stick  |f*| <= mu N:  f = f*,         h stays
  ///   slip   otherwise:     f = mu_k N t,   e = (mu_k N t + (c_t/dt) e_old)/(k_t + c_t/dt)
  /// so that f = k_t e + c_t (e - e_old)/dt also holds while slipping. Where the damper alone would
  /// pull (N = 0) the slip line reads e' = -(k_t/c_t) e: no friction, and the stretch relaxes. `dt`
  /// [s] is the step of the commit. Needs k_t > 0 and dt > 0. O(1), pure, no branch on state.
  template <class Real>
  static Reaction<Real> evaluate(const PointKinematics<Real>& point, const Memory<Real>& memory,
                                 const MaterialConstants<Real>& material, const Real& dt) {
    const Real normal_force = spring_damper_normal_force(point, material);
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
};

}  // namespace hookpoint::contact
