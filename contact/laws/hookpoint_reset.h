// The rule of McMillan's DynaMechs, the ancestor of the paper's system: when friction is exceeded
// the hook is thrown to the foot. That empties the spring, which must then be stretched again; kept
// so that a study can show what it costs.
#pragma once

#include "contact/laws/clipped_bristle.h"
#include "contact/laws/hook.h"

namespace hookpoint::contact {

/// Least stretch from which a hook is thrown [m], far below any that matters: where the damper
/// alone is at the cone's edge the saw of a thrown hook has infinitely many teeth.
inline constexpr double least_thrown_stretch = 1e-9;

/// A law with a ThrownHook as dt -> 0. What sticks does so until |f*| = mu_s N, when its
/// hook is thrown to the foot (an event); from there it slips, e = 0 and f = mu_k N v/|v|, while
/// the damper leaves the spring less than the least stretch, c_t |v| + k_t e_least > mu_k N, else
/// it sticks again.
template <class Law>
struct ThrownHookRateForm : Law {
  static constexpr std::size_t bristle_states = 3;

  /// Force on the robot, bristle rate and next memory of one point with Law's normal force. The
  /// memory says whether the point slips; one that sticks and is found beyond the cone is at its
  /// event, or a trial state past it, which continues smoothly. O(1), pure, no branch on state.
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

/// A hook that slip throws to the foot: e = 0, h is the point's projection.
struct ThrownHook {
  template <class Law>
  using RateForm = ThrownHookRateForm<Law>;

  template <class Real>
  static Vector3<Real> slipped_stretch(const HookTrial<Real>& /*trial*/,
                                       const Vector3<Real>& /*kinetic*/,
                                       const MaterialConstants<Real>& /*material*/,
                                       const Real& /*dt*/) {
    return {};
  }
};

struct HookpointReset : HookedSpringDamper<HookpointReset, ThrownHook> {
  static constexpr const char* name = "hookpoint_reset";
  static constexpr const char* source = "McMillan 1995 (DynaMechs)";
  static constexpr const char* summary =
      "as hookpoint, but slip throws the hook to the foot; loses friction as dt -> 0";

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
