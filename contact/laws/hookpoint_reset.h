// The rule of McMillan's DynaMechs, the ancestor of the paper's system: when friction is exceeded
// the hook is thrown to the foot. That empties the spring, which must then be stretched anew; kept
// so that a study can show what it costs.
#pragma once

#include "contact/laws/clipped_bristle.h"
#include "contact/laws/spring_damper.h"

namespace hookpoint::contact {

/// The reaction of a point with normal force `normal_force` N [N] and a hook that slip throws to
/// the foot:
///   stick  |f*| <= mu N:  f = f*,         h stays
///   slip   otherwise:     f = mu_k N t,   e = 0: h is the point's projection
/// `dt` [s], the step of the commit, matters only for where a path crossed the surface. Needs
/// dt > 0. O(1), pure, no branch on state.
template <class Real>
Reaction<Real> thrown_hook_reaction(const PointKinematics<Real>& point, const Memory<Real>& memory,
                                    const MaterialConstants<Real>& material, const Real& dt,
                                    const Real& normal_force) {
  const HookTrial<Real> trial = hook_trial(point, memory, material, dt);
  const Mask<Real> slips = trial_slips(trial, normal_force, material);

  const Vector3<Real> kinetic = kinetic_friction_force(trial, normal_force, material);
  const Vector3<Real> friction = select(slips, kinetic, trial.force);

  const Vector3<Real> stretch = select(slips, Vector3<Real>{}, trial.stretch);
  const Vector3<Real> hook = select(slips, trial.surface, trial.hook);
  return hook_reaction(point, trial, normal_force, friction, stretch, hook, slips);
}

/// Least stretch from which a hook is thrown [m], far below any that matters: where the damper
/// alone is at the cone's edge the saw of a thrown hook has infinitely many teeth.
inline constexpr double least_thrown_stretch = 1e-9;

/// A law with thrown_hook_reaction as dt -> 0. What sticks does so until |f*| = mu_s N, when its
/// hook is thrown to the foot (an event); from there it slips, e = 0 and f = mu_k N v/|v|, while
/// the damper leaves the spring less than the least stretch, c_t |v| + k_t e_least > mu_k N, else
/// it sticks again.
template <class Law>
struct ThrownHookRateForm : Law {
  static constexpr std::size_t bristle_states = 3;

  /// Force on the robot, bristle rate and next memory of one point with Law's normal force. The
  /// memory says whether the point slips; one that sticks and is found beyond the cone is at its
  /// event, or a trial state past it, which goes on smoothly. O(1), pure, no branch on state.
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

  /// Where the hook is thrown, and where a slipping point comes to stick.
  static double switching_value(const PointKinematics<double>& point, const Memory<double>& memory,
                                const Constants& material) {
    const double depth_rate = -dot(point.velocity, point.normal);
    const double least = material.tangential_stiffness * least_thrown_stretch;
    return friction_left(point, memory, material,
                         Law::normal_force(point.depth, depth_rate, material)) -
           (memory.sliding ? least : 0.);
  }
};

struct HookpointReset : SpringDamperPredictions {
  static constexpr const char* name = "hookpoint_reset";
  static constexpr const char* source = "McMillan 1995 (DynaMechs)";
  static constexpr const char* summary =
      "as hookpoint, but slip throws the hook to the foot; loses friction as dt -> 0";
  static constexpr ConstantList constants{
      &Constants::normal_stiffness,   &Constants::normal_damping,  &Constants::tangential_stiffness,
      &Constants::tangential_damping, &Constants::static_friction, &Constants::kinetic_friction};
  static constexpr ConstantList own_constants{};
  using RateForm = ThrownHookRateForm<HookpointReset>;

  /// Force on the robot and next memory of one point: N = max(0, k d + c d'), friction by
  /// thrown_hook_reaction, whose needs are this law's.
  template <class Real>
  static Reaction<Real> evaluate(const PointKinematics<Real>& point, const Memory<Real>& memory,
                                 const MaterialConstants<Real>& material, const Real& dt) {
    return thrown_hook_reaction(
        point, memory, material, dt,
        normal_force(point.depth, Real(-dot(point.velocity, point.normal)), material));
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
