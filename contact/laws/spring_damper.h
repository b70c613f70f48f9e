// The linear spring-damper along the normal, and its closed forms.
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

/// Closed forms of a linear spring-damper along the normal with a tangential spring that holds.
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
