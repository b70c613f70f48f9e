// The hook: a tangential spring-damper from the point to where it came into the ground, and the
// trial that decides between stick and slip (Reichler & Delcomyn 2000, 3.3; docs/contact.md). The
// laws with a hook differ in what slip does to it, and in the force along the normal.
#pragma once

#include "contact/laws/spring_damper.h"

namespace hookpoint::contact {

/// The hook before it is decided whether the point slips. World axes.
template <class Real>
struct HookTrial {
  Vector3<Real> surface;  ///< the point's projection on the tile's plane [m]
  /// h on the tile's plane: the committed hook, or where the path crossed the plane [m].
  Vector3<Real> hook;
  Vector3<Real> stretch;      ///< e + dx: tangential part of x - h [m]
  Vector3<Real> old_stretch;  ///< e_old, turned into the tile's plane [m]
  Vector3<Real> force;        ///< f* = k_t (e + dx) + c_t dx/dt, on the ground [N]
  Mask<Real> inside{};        ///< delta > 0
  Mask<Real> sliding{};       ///< the last commit was a slip of this very contact
};

/// Time since the point crossed the tile's plane on a straight path, within the last step; 0 for a
/// point put into the ground at rest [s].
template <class Real>
Real time_since_crossing(const PointKinematics<Real>& point, const Real& dt) {
  const Real depth_rate = -dot(point.velocity, point.normal);
  const Mask<Real> entering = depth_rate > Real(0.);
  const Real since = max(Real(0.), min(dt, point.depth / select(entering, depth_rate, Real(1.))));
  return select(entering, since, Real(0.));
}

/// The trial of a point with committed memory `memory` over a step `dt` [s]. The hook is projected
/// on the tile now under the point, so that it stays on the surface when the point has crossed an
/// edge.
template <class Real>
HookTrial<Real> hook_trial(const PointKinematics<Real>& point, const Memory<Real>& memory,
                           const MaterialConstants<Real>& material, const Real& dt) {
  HookTrial<Real> trial;
  trial.inside = point.depth > Real(0.);
  const Mask<Real> held = trial.inside && memory.attached;
  trial.sliding = held && memory.sliding;
  trial.surface = point.position + point.depth * point.normal;

  const Vector3<Real> crossing = point.position - time_since_crossing(point, dt) * point.velocity;
  const Vector3<Real> anchor = select(held, memory.hook, crossing);
  trial.hook = anchor + dot(trial.surface - anchor, point.normal) * point.normal;
  trial.stretch = tangential(point.position - anchor, point.normal);
  trial.old_stretch = select(held, tangential(memory.stretch, point.normal), Vector3<Real>{});
  trial.force = material.tangential_stiffness * trial.stretch +
                material.tangential_damping * tangential(point.velocity, point.normal);
  return trial;
}

/// Whether the trial force leaves the friction cone: |f*| > mu_s N, or mu_k N while sliding.
template <class Real>
Mask<Real> trial_slips(const HookTrial<Real>& trial, const Real& normal_force,
                       const MaterialConstants<Real>& material) {
  const Real friction = select(trial.sliding, material.kinetic_friction, material.static_friction);
  return norm(trial.force) > friction * normal_force;
}

/// mu_k N t with t = f*/|f*|, the friction of a slipping point (0 where the trial is 0), on the
/// ground [N].
template <class Real>
Vector3<Real> kinetic_friction_force(const HookTrial<Real>& trial, const Real& normal_force,
                                     const MaterialConstants<Real>& material) {
  const Real magnitude = norm(trial.force);
  const Mask<Real> directed = magnitude > Real(0.);
  const Real scale =
      material.kinetic_friction * normal_force / select(directed, magnitude, Real(1.));
  return scale * trial.force;
}

/// The reaction of a point with normal force `normal_force` N [N] and a hook that `Slip` moves:
///   stick  |f*| <= mu N:  f = f*,         h stays
///   slip   otherwise:     f = mu_k N t,   e = Slip::slipped_stretch, h on the surface at x - e
/// Outside the ground nothing, and no memory. `dt` [s] is the step of the commit. Needs dt > 0.
/// O(1), pure, no branch on state.
template <class Slip, class Real>
Reaction<Real> hooked_reaction(const PointKinematics<Real>& point, const Memory<Real>& memory,
                               const MaterialConstants<Real>& material, const Real& dt,
                               const Real& normal_force) {
  const HookTrial<Real> trial = hook_trial(point, memory, material, dt);
  const Mask<Real> slips = trial_slips(trial, normal_force, material);

  const Vector3<Real> kinetic = kinetic_friction_force(trial, normal_force, material);
  const Vector3<Real> friction = select(slips, kinetic, trial.force);

  const Vector3<Real> slipped = Slip::slipped_stretch(trial, kinetic, material, dt);
  const Vector3<Real> stretch = select(slips, slipped, trial.stretch);
  const Vector3<Real> hook = select(slips, trial.surface - slipped, trial.hook);

  const Vector3<Real> zero{};
  Reaction<Real> reaction;
  reaction.force = select(trial.inside, normal_force * point.normal - friction, zero);
  reaction.next.hook = select(trial.inside, hook, zero);
  reaction.next.stretch = select(trial.inside, stretch, zero);
  reaction.next.attached = trial.inside;
  reaction.next.sliding = trial.inside && slips;
  return reaction;
}

/// A law with a hook, complete but for its name: a linear spring-damper along the normal, or
/// Law::normal_force, and hooked_reaction. `Slip` has slipped_stretch, and RateForm<Law>.
template <class Law, class Slip>
struct HookedSpringDamper : SpringDamperPredictions {
  static constexpr ConstantList constants{
      &Constants::normal_stiffness,   &Constants::normal_damping,  &Constants::tangential_stiffness,
      &Constants::tangential_damping, &Constants::static_friction, &Constants::kinetic_friction};
  static constexpr ConstantList own_constants{};
  using RateForm = typename Slip::template RateForm<Law>;

  /// Force on the robot and next memory of one point.
  template <class Real>
  static Reaction<Real> evaluate(const PointKinematics<Real>& point, const Memory<Real>& memory,
                                 const MaterialConstants<Real>& material, const Real& dt) {
    const Real depth_rate = -dot(point.velocity, point.normal);
    return hooked_reaction<Slip>(point, memory, material, dt,
                                 Law::normal_force(point.depth, depth_rate, material));
  }
};

}  // namespace hookpoint::contact
