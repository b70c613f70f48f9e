// What the laws with a hook share: the linear spring-damper along the normal, and the trial that a
// law makes before it decides between stick and slip (Reichler & Delcomyn 2000, 3.3;
// docs/contact.md). They differ only in what slip does to the hook, which is what their own files
// say.
#pragma once

#include "contact/law_interface.h"

namespace hookpoint::contact {

/// N = max(0, k delta + c delta') inside the ground, 0 outside [N]: the damper never pulls the
/// point down. `depth` delta [m], `depth_rate` delta' [m/s].
template <class Real>
Real spring_damper_normal_force(const Real& depth, const Real& depth_rate,
                                const MaterialConstants<Real>& material) {
  const Real force =
      max(Real(0.), material.normal_stiffness * depth + material.normal_damping * depth_rate);
  return select(depth > Real(0.), force, Real(0.));
}

/// The hook before it is decided whether the point slips. World axes.
template <class Real>
struct HookTrial {
  Vector3<Real> surface;  ///< the point's projection on the tile's plane [m]
  Vector3<Real>
      hook;  ///< h on the tile's plane: the committed hook, or where the path crossed the plane [m]
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

/// The reaction of a point inside the ground with stretch `stretch`, friction `friction` (on the
/// ground) and next hook; nothing, and no memory, outside.
template <class Real>
Reaction<Real> hook_reaction(const PointKinematics<Real>& point, const HookTrial<Real>& trial,
                             const Real& normal_force, const Vector3<Real>& friction,
                             const Vector3<Real>& next_stretch, const Vector3<Real>& next_hook,
                             const Mask<Real>& slips) {
  const Vector3<Real> zero{};
  Reaction<Real> reaction;
  reaction.force = select(trial.inside, normal_force * point.normal - friction, zero);
  reaction.next.hook = select(trial.inside, next_hook, zero);
  reaction.next.stretch = select(trial.inside, next_stretch, zero);
  reaction.next.attached = trial.inside;
  reaction.next.sliding = trial.inside && slips;
  return reaction;
}

/// What every law with a linear spring-damper and a hook shares.
struct SpringDamperPredictions : WithoutBristle {
  static constexpr NormalConstants normal_constants{&Constants::normal_stiffness, "N/m",
                                                    &Constants::normal_damping};

  template <class Real>
  static Real normal_force(const Real& depth, const Real& depth_rate,
                           const MaterialConstants<Real>& material) {
    return spring_damper_normal_force(depth, depth_rate, material);
  }
  /// Penetration under a steady normal load [N] on one point: N/k [m].
  static double static_depth(double load, const MaterialConstants<double>& material) {
    return load / material.normal_stiffness;
  }
  /// Shift of a sticking point under a steady tangential load [N], whatever the normal load [N]:
  /// f/k_t [m].
  static std::optional<double> stick_displacement(double load, double /*normal_load*/,
                                                  const MaterialConstants<double>& material) {
    return load / material.tangential_stiffness;
  }
  /// Steady speed on a slope whose tangent is within the friction cone: a hook holds, 0 [m/s].
  /// None: it slides away.
  static std::optional<double> creep_speed(double tangent_of_slope,
                                           const MaterialConstants<double>& material) {
    return holds_on_slope(tangent_of_slope, material.static_friction) ? std::optional(0.)
                                                                      : std::nullopt;
  }
  /// Rebound speed over impact speed of a mass [kg] on one point, no gravity; independent of the
  /// speed [m/s].
  static double restitution(double mass, double /*speed*/,
                            const MaterialConstants<double>& material) {
    return kelvin_voigt_restitution(material.normal_damping /
                                    (2. * std::sqrt(material.normal_stiffness * mass)));
  }
  /// Stiffness and damping of one point; the same under every load [N].
  static LinearContact linearise(double /*load*/, const MaterialConstants<double>& material) {
    return {material.normal_stiffness, material.normal_damping, material.tangential_stiffness,
            material.tangential_damping};
  }
  /// Energy in the springs of a point with penetration `depth` [m] and stretch e [m]: k delta^2/2 +
  /// k_t e^2/2 [J].
  static double stored_energy(double depth, const Vector3d& stretch,
                              const MaterialConstants<double>& material) {
    const double inside = max(0., depth);
    return 0.5 * (material.normal_stiffness * inside * inside +
                  material.tangential_stiffness * dot(stretch, stretch));
  }
};

}  // namespace hookpoint::contact
