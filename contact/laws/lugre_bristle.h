// The bristle that LuGre and the elastoplastic law share: they differ in how much of the motion is
// plastic (alpha), which is what their own files say.
#pragma once

#include "contact/laws/bristle.h"
#include "contact/laws/spring_damper.h"
#include "contact/laws/stribeck.h"

namespace hookpoint::contact {

/// The deflection z bent no farther than `limit` [N] >= 0 can hold: k_t |z| <= limit. What a
/// falling load no longer holds slips.
template <class Real>
Vector3<Real> held_deflection(const Vector3<Real>& z, const MaterialConstants<Real>& material,
                              const Real& limit) {
  const Real force = material.tangential_stiffness * norm(z);
  return select(force > limit, (limit / positive_or_one(force)) * z, z);
}

/// A bristle under its load, before the law decides how much of its motion is plastic. World axes.
template <class Real>
struct LoadedBristle {
  Vector3<Real> deflection;  ///< z, as it was integrated [m]
  Vector3<Real> held;        ///< z, as far as mu_s N holds it [m]
  Vector3<Real> velocity;    ///< v, of the point along the tile [m/s]
  Real speed{};              ///< |v| [m/s]
  Real normal_force{};       ///< N [N]
  Real steady{};             ///< g(v) = mu(v) N, Stribeck's friction [N]
};

template <class Real>
LoadedBristle<Real> loaded_bristle(const PointKinematics<Real>& point,
                                   const MaterialConstants<Real>& material) {
  LoadedBristle<Real> bristle;
  bristle.normal_force =
      spring_damper_normal_force(point.depth, Real(-dot(point.velocity, point.normal)), material);
  bristle.deflection = tangential(point.bristle.deflection, point.normal);
  bristle.held = held_deflection(bristle.deflection, material,
                                 Real(material.static_friction * bristle.normal_force));
  bristle.velocity = tangential(point.velocity, point.normal);
  bristle.speed = norm(bristle.velocity);
  bristle.steady = stribeck_friction(bristle.speed, material) * bristle.normal_force;
  return bristle;
}

/// The rate of a bristle and how much of it a step resolves.
template <class Real>
struct BristleRate {
  Vector3<Real> rate;  ///< z' [m/s]
  Real resolved{};     ///< s, 1 where the step resolves the relaxation, towards 0 where it does not
};

/// z' = s (v - alpha k_t |v| z/g(v)) (Canudas de Wit et al. 1995 with alpha = 1, Dupont et al.
/// 2002; both with s = 1). With s = min(1, g/(k_t |v| tau)) it is no faster than to be relaxed
/// after tau, a step `dt` [s], where it then ends at its steady value, or `shortest_relaxation`: as
/// the load vanishes the relaxation would have no bound.
template <class Real>
BristleRate<Real> bristle_rate(const LoadedBristle<Real>& bristle, const Real& alpha,
                               const MaterialConstants<Real>& material, const Real& dt) {
  const Real drag = material.tangential_stiffness * bristle.speed;  // k_t |v|
  const Vector3<Real> numerator =
      bristle.steady * bristle.velocity - (alpha * drag) * bristle.deflection;
  const Real least_time = max(dt, Real(shortest_relaxation));
  const Real divisor = positive_or_one(Real(max(bristle.steady, drag * least_time)));
  return {(1. / divisor) * numerator, bristle.steady / divisor};
}

/// f = s k_t z + (1 - s) g(v) v/|v| + sigma1(v) z' + sigma2 v where the ground carries load, and
///   sigma1(v) = c_t/(1 + c_t |v|/g(v)),
/// c_t at rest and falling with speed, as Olsson et al. 1998 require: with sigma1 |v| <= g the
/// bristle gives back no more energy than it took, at any speed. What a step does not resolve of
/// the relaxation is Coulomb's friction, and so takes energy too: without dampers
///   f.v - k_t z.z' = (1 - s) g |v| + s alpha |v| (k_t z)^2/g >= 0   for any s and alpha, and any z
/// that mu_s N holds, as every accepted state's is. [N]
template <class Real>
Reaction<Real> lugre_reaction(const PointKinematics<Real>& point,
                              const LoadedBristle<Real>& bristle, const Real& alpha,
                              const MaterialConstants<Real>& material, const Real& dt) {
  const Mask<Real> loaded = bristle.normal_force > Real(0.);
  BristleFriction<Real> friction;
  const BristleRate<Real> bending = bristle_rate(bristle, alpha, material, dt);
  friction.rate = bending.rate;
  const Real sigma1 =
      material.tangential_damping * bristle.steady /
      positive_or_one(Real(bristle.steady + material.tangential_damping * bristle.speed));
  const Real unresolved = (1. - bending.resolved) * bristle.steady / positive_or_one(bristle.speed);
  const Vector3<Real> force = (bending.resolved * material.tangential_stiffness) * bristle.held +
                              sigma1 * friction.rate +
                              (unresolved + material.viscous_friction) * bristle.velocity;
  friction.force = select(loaded, force, Vector3<Real>{});
  // More of the motion is slip than bending.
  friction.slips = 0.5 * bristle.speed * bristle.speed > dot(friction.rate, bristle.velocity);
  return bristle_reaction(point, point.depth > Real(0.), bristle.normal_force, bristle.held,
                          friction);
}

/// Predictions that both share; the normal direction is the linear spring-damper's.
struct LugrePredictions {
  static constexpr NormalConstants normal_constants = SpringDamperPredictions::normal_constants;
  static constexpr std::size_t bristle_states = 3;
  static double reach(const MaterialConstants<double>& /*material*/) { return 0.; }
  /// N/k [m].
  static double static_depth(double load, const MaterialConstants<double>& material) {
    return SpringDamperPredictions::static_depth(load, material);
  }
  /// Under a steady pull within mu_s N the bristle comes to rest at z = f/k_t: 0 [m/s]; none
  /// beyond.
  static std::optional<double> creep_speed(double tangent_of_slope,
                                           const MaterialConstants<double>& material) {
    return SpringDamperPredictions::creep_speed(tangent_of_slope, material);
  }
  /// The clamped Kelvin-Voigt body's.
  static double restitution(double mass, double speed, const MaterialConstants<double>& material) {
    return SpringDamperPredictions::restitution(mass, speed, material);
  }
  /// About rest, z following the point: k, c, k_t, c_t + sigma2.
  static LinearContact linearise(double /*load*/, const MaterialConstants<double>& material) {
    return {material.normal_stiffness, material.normal_damping, material.tangential_stiffness,
            material.tangential_damping + material.viscous_friction};
  }
  /// k d^2/2 + k_t z^2/2 [J].
  static double stored_energy(double depth, const Vector3d& stretch,
                              const MaterialConstants<double>& material) {
    return SpringDamperPredictions::stored_energy(depth, stretch, material);
  }
  /// Sliding speed up to which a step dt [s] resolves the relaxation k_t |v|/g of a bristle under a
  /// load N [N]: mu_k N/(k_t dt) [m/s].
  static double resolved_speed(double load, double dt, const MaterialConstants<double>& material) {
    return material.kinetic_friction * load / (material.tangential_stiffness * dt);
  }
  static double switching_value(const PointKinematics<double>& point, const Memory<double>& memory,
                                const Constants& /*material*/) {
    return slip_reversal(point, memory);
  }
  static bool slides_after(bool /*falling*/, const Memory<double>& memory,
                           const Constants& /*material*/) {
    return memory.sliding;
  }
};

}  // namespace hookpoint::contact
