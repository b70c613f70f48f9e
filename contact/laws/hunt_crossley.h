// Hunt & Crossley's normal force (1975), whose damping grows with the penetration so that it
// neither jumps at touch-down nor pulls, with regularised Coulomb friction and Stribeck's drop from
// static to kinetic. No memory: it must creep.
#pragma once

#include "contact/law_interface.h"
#include "contact/laws/stribeck.h"

namespace hookpoint::contact {

/// The regularisation phi(s) = s/sqrt(1 + s^2): odd, smooth, phi'(0) = 1, phi -> 1.
inline double friction_regularisation(double s) { return s / std::sqrt(1. + s * s); }
/// Its inverse, y/sqrt(1 - y^2) for |y| < 1.
inline double friction_regularisation_inverse(double y) { return y / std::sqrt(1. - y * y); }

struct HuntCrossley : WithoutBristle {
  static constexpr const char* name = "hunt_crossley";
  static constexpr const char* source = "Hunt & Crossley 1975";
  static constexpr const char* summary =
      "k d^n (1 + alpha d'); friction a smooth function of velocity, no memory: creeps";
  static constexpr ConstantList constants{
      &Constants::normal_stiffness, &Constants::exponent,         &Constants::hysteresis_damping,
      &Constants::static_friction,  &Constants::kinetic_friction, &Constants::regularisation_speed,
      &Constants::stribeck_speed};
  static constexpr ConstantList own_constants{&Constants::exponent, &Constants::hysteresis_damping,
                                              &Constants::regularisation_speed,
                                              &Constants::stribeck_speed};
  static constexpr NormalConstants normal_constants{&Constants::normal_stiffness, "N/m^exponent",
                                                    &Constants::hysteresis_damping};
  using RateForm = HuntCrossley;

  /// Force on the robot and next memory of one point; the memory only tells that the point is
  /// inside.
  ///   N = max(0, k d^n (1 + alpha d')),   f = -mu(|v|) N phi(|v|/v_s) v/|v| = -mu(|v|) N
  ///   v/sqrt(v_s^2 + |v|^2)
  /// Needs v_s > 0, v_St > 0. O(1), pure, no branch on state.
  template <class Real>
  static Reaction<Real> evaluate(const PointKinematics<Real>& point, const Memory<Real>& /*memory*/,
                                 const MaterialConstants<Real>& material, const Real& /*dt*/) {
    using std::pow;
    const Mask<Real> inside = point.depth > Real(0.);
    const Real depth = select(inside, point.depth, Real(0.));
    const Real depth_rate = -dot(point.velocity, point.normal);
    const Real elastic = material.normal_stiffness * pow(depth, material.exponent);
    const Real normal_force =
        max(Real(0.), elastic * (1. + material.hysteresis_damping * depth_rate));

    const Vector3<Real> slip_velocity = tangential(point.velocity, point.normal);
    const Real speed_squared = dot(slip_velocity, slip_velocity);
    const Real regularised =
        sqrt(speed_squared + material.regularisation_speed * material.regularisation_speed);
    const Real friction =
        stribeck_friction(Real(sqrt(speed_squared)), material) * normal_force / regularised;

    Reaction<Real> reaction;
    reaction.force =
        select(inside, normal_force * point.normal - friction * slip_velocity, Vector3<Real>{});
    reaction.next.hook =
        select(inside, point.position + point.depth * point.normal, Vector3<Real>{});
    reaction.next.attached = inside;
    return reaction;
  }

  /// Penetration under a steady normal load [N] on one point: (N/k)^(1/n) [m].
  static double static_depth(double load, const MaterialConstants<double>& material) {
    return std::pow(load / material.normal_stiffness, 1. / material.exponent);
  }
  /// No spring holds a point: a steady tangential load [N] moves it for ever, and its elastic shift
  /// is 0 [m].
  static std::optional<double> stick_displacement(double /*load*/, double /*normal_load*/,
                                                  const MaterialConstants<double>& /*material*/) {
    return 0.;
  }
  /// Steady speed v on a slope of tangent tan(theta) >= 0: the least root of mu(v) phi(v/v_s) =
  /// tan(theta) [m/s]; none when friction never reaches the slope's pull and the body slides away.
  static std::optional<double> creep_speed(double tangent_of_slope,
                                           const MaterialConstants<double>& material);
  /// Rebound speed over impact speed at `speed` [m/s], no gravity; independent of the mass [kg].
  static double restitution(double /*mass*/, double speed,
                            const MaterialConstants<double>& material) {
    return hunt_crossley_restitution(material.hysteresis_damping * speed);
  }
  /// Stiffness and damping about rest under a normal load N [N]: n k d^(n-1), alpha N, and
  /// tangentially 0, mu_s N/v_s.
  static LinearContact linearise(double load, const MaterialConstants<double>& material) {
    const double depth = static_depth(load, material);
    return {material.exponent * material.normal_stiffness * std::pow(depth, material.exponent - 1.),
            material.hysteresis_damping * load, 0.,
            material.static_friction * load / material.regularisation_speed};
  }
  /// Energy in the normal spring, k d^(n+1)/(n + 1) [J]; the tangential part stores none.
  static double stored_energy(double depth, const Vector3d& /*stretch*/,
                              const MaterialConstants<double>& material) {
    const double inside = max(0., depth);
    return material.normal_stiffness * std::pow(inside, material.exponent + 1.) /
           (material.exponent + 1.);
  }
};

}  // namespace hookpoint::contact
