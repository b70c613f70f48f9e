// The rule of McMillan's DynaMechs, the ancestor of the paper's system: when friction is exceeded
// the hook is thrown to the foot. That empties the spring, which must then be stretched anew; kept
// so that a study can show what it costs.
#pragma once

#include "contact/laws/spring_damper.h"

namespace hookpoint::contact {

struct HookpointReset : SpringDamperPredictions {
  static constexpr const char* name = "hookpoint_reset";
  static constexpr const char* source = "McMillan 1995 (DynaMechs)";
  static constexpr const char* summary =
      "as hookpoint, but slip throws the hook to the foot; loses friction as dt -> 0";

  /// Force on the robot and next memory of one point.
  ///   stick  |f*| <= mu N:  f = f*,         h stays
  ///   slip   otherwise:     f = mu_k N t,   h = the point's projection (e = 0)
  /// Arguments as Hookpoint::evaluate; `dt` matters only for where a path crossed the surface.
  template <class Real>
  static Reaction<Real> evaluate(const PointKinematics<Real>& point, const Memory<Real>& memory,
                                 const MaterialConstants<Real>& material, const Real& dt) {
    const Real N = normal_force(point.depth, Real(-dot(point.velocity, point.normal)), material);
    const HookTrial<Real> trial = hook_trial(point, memory, material, dt);
    const Mask<Real> slips = trial_slips(trial, N, material);

    const Vector3<Real> kinetic = kinetic_friction_force(trial, N, material);
    const Vector3<Real> friction = select(slips, kinetic, trial.force);
    const Vector3<Real> stretch = select(slips, Vector3<Real>{}, trial.stretch);
    const Vector3<Real> hook = select(slips, trial.surface, trial.hook);
    return hook_reaction(point, trial, N, friction, stretch, hook, slips);
  }

  /// Mean friction of a point that slides at `speed` [m/s] under normal force N [N], as dt -> 0
  /// [N]: the spring climbs from the damper's c_t v to mu_s N, one step empties it, and it climbs
  /// again: (mu_s N + min(c_t v, mu_s N))/2. Half of mu_s N at low speed, so that stopping takes up
  /// to twice the distance; the return map keeps mu_k N.
  static double mean_sliding_friction(double speed, double normal_force,
                                      const MaterialConstants<double>& material) {
    const double limit = material.static_friction * normal_force;
    return 0.5 * (limit + min(material.tangential_damping * speed, limit));
  }
};

}  // namespace hookpoint::contact
