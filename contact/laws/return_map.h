// The return mapping that drags a hook along when friction is exceeded (Simo & Hughes 1998, applied
// to the hook of Reichler & Delcomyn 2000, 3.3), whatever law gives the normal force.
#pragma once

#include "contact/laws/spring_damper.h"

namespace hookpoint::contact {

/// The reaction of a point with normal force `normal_force` N [N] and a hook:
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

}  // namespace hookpoint::contact
