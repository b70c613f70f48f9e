// LuGre friction (Canudas de Wit, Olsson, Astrom & Lischinsky 1995): bristles that bend, and slip a
// little whenever they move. So it drifts under vibration, which is why it is here.
#pragma once

#include "contact/laws/lugre_bristle.h"

namespace hookpoint::contact {

struct Lugre : LugrePredictions {
  static constexpr const char* name = "lugre";
  static constexpr const char* source = "Canudas de Wit et al. 1995";
  static constexpr const char* summary =
      "linear spring-damper; bristle z' = v - k_t |v| z/g(v) with Stribeck: drifts when shaken";
  static constexpr ConstantList constants{
      &Constants::normal_stiffness,   &Constants::normal_damping,  &Constants::tangential_stiffness,
      &Constants::tangential_damping, &Constants::static_friction, &Constants::kinetic_friction,
      &Constants::stribeck_speed,     &Constants::viscous_friction};
  static constexpr ConstantList own_constants{};
  using RateForm = Lugre;

  /// Force on the robot, bristle rate and next memory of one point: N = max(0, k d + c d'),
  ///   z' = v - k_t |v| z/g(v),   f = k_t z + sigma1(v) z' + sigma2 v,   g = mu(v) N
  /// Only k_t z is within the cone; |f| <= 3 mu_s N + sigma2 |v|. O(1), pure, no branch on state.
  template <class Real>
  static Reaction<Real> evaluate(const PointKinematics<Real>& point, const Memory<Real>& /*memory*/,
                                 const MaterialConstants<Real>& material, const Real& dt) {
    return lugre_reaction(point, loaded_bristle(point, material), Real(1.), material, dt);
  }

  /// Shift under a tangential load f [N] that grows slowly while N [N] is steady: from dz = (1 -
  /// z/z_s) dx, x = -z_s ln(1 - f/(mu_s N)) with z_s = mu_s N/k_t [m], more than f/k_t since some
  /// of it is slip; none at mu_s N and above. A load that comes at once overshoots and slips more.
  static std::optional<double> stick_displacement(double load, double normal_load,
                                                  const MaterialConstants<double>& material) {
    const double limit = material.static_friction * normal_load;
    if (load >= limit) return std::nullopt;
    return -limit / material.tangential_stiffness * std::log1p(-load / limit);
  }

  /// Drift [m] in one slow cycle of a tangential load between `least` and `greatest` [N] under a
  /// steady N [N]: loading dx = dz/(1 - z/z_s), unloading dx = dz/(1 + z/z_s), together
  /// z_s ln((1 - s1^2)/(1 - s2^2)), s = f/(mu_s N). 0 for a load about 0.
  static double drift_per_cycle(double least, double greatest, double normal_load,
                                const MaterialConstants<double>& material) {
    const double limit = material.static_friction * normal_load;
    const double s1 = least / limit, s2 = greatest / limit;
    return limit / material.tangential_stiffness * std::log((1. - s1 * s1) / (1. - s2 * s2));
  }
};

}  // namespace hookpoint::contact
