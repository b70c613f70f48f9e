// The paper's own proposal for feet that must not slip: soft ground up to a nominal depth, so that
// a foot stays in it while its load varies, and stiff ground beyond (Reichler & Delcomyn 2000,
// 3.3).
#pragma once

#include "contact/laws/hookpoint.h"
#include "contact/laws/impact.h"

namespace hookpoint::contact {

struct Nominal : HookedSpringDamper<Nominal, DraggedHook> {
  static constexpr const char* name = "nominal";
  static constexpr const char* source = "Reichler & Delcomyn 2000, 3.3";
  static constexpr const char* summary =
      "as hookpoint, but soft (k1) up to the nominal depth d0 and stiff (k) beyond it";
  static constexpr ConstantList constants{
      &Constants::normal_stiffness,     &Constants::normal_damping,
      &Constants::tangential_stiffness, &Constants::tangential_damping,
      &Constants::static_friction,      &Constants::kinetic_friction,
      &Constants::nominal_stiffness,    &Constants::nominal_penetration,
      &Constants::blend_width};
  static constexpr ConstantList own_constants{&Constants::nominal_stiffness,
                                              &Constants::nominal_penetration};
  static constexpr NormalConstants normal_constants{&Constants::nominal_stiffness, "N/m",
                                                    &Constants::normal_damping};

  /// The spring's force [N] at `depth` d >= 0 [m]:
  ///   k1 d                             d <= d0
  ///   k1 d + (k - k1) (d - d0)^2/(2w)  d <= d0 + w
  ///   k1 d + (k - k1) (d - d0 - w/2)   beyond
  /// C1 for w > 0; with w = 0 the slope jumps at d0.
  template <class Real>
  static Real spring_force(const Real& depth, const MaterialConstants<Real>& material) {
    const Real beyond = max(Real(0.), depth - material.nominal_penetration);
    const Real blended = min(beyond, material.blend_width);
    const Real half_square = blended * blended / (2. * blend_divisor(material));
    return material.nominal_stiffness * depth +
           (material.normal_stiffness - material.nominal_stiffness) *
               (half_square + (beyond - blended));
  }

  /// N = max(0, spring_force(d) + c d') inside the ground, 0 outside [N].
  template <class Real>
  static Real normal_force(const Real& depth, const Real& depth_rate,
                           const MaterialConstants<Real>& material) {
    const Real force =
        max(Real(0.), spring_force(depth, material) + material.normal_damping * depth_rate);
    return select(depth > Real(0.), force, Real(0.));
  }

  /// Penetration under a steady normal load N [N] on one point, the inverse of spring_force [m];
  /// d0 for k1 = N/d0.
  static double static_depth(double load, const MaterialConstants<double>& material);
  /// Rebound speed over impact speed of a mass [kg] at `speed` [m/s], no gravity: 1 without
  /// damping; the Kelvin-Voigt body's while the spring is one line; else integrated.
  static double restitution(double mass, double speed, const MaterialConstants<double>& material);
  /// Stiffness and damping about rest under a load [N]: the spring's slope at the static depth, c,
  /// k_t, c_t.
  static LinearContact linearise(double load, const MaterialConstants<double>& material);
  /// Energy in the springs of a point with penetration `depth` [m] and stretch e [m]: the integral
  /// of spring_force, and k_t e^2/2 [J].
  static double stored_energy(double depth, const Vector3d& stretch,
                              const MaterialConstants<double>& material);

 private:
  template <class Real>
  static Real blend_divisor(const MaterialConstants<Real>& material) {
    return select(material.blend_width > Real(0.), material.blend_width, Real(1.));
  }
};

}  // namespace hookpoint::contact
