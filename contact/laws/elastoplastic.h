// The elastoplastic friction of Dupont, Hayward, Armstrong & Altpeter (2002): LuGre whose bristles
// only bend below a break-away deflection, and so hold still when shaken below it.
#pragma once

#include <numbers>

#include "contact/laws/lugre_bristle.h"

namespace hookpoint::contact {

struct Elastoplastic : LugrePredictions {
  static constexpr const char* name = "elastoplastic";
  static constexpr const char* source = "Dupont et al. 2002";
  static constexpr const char* summary =
      "as lugre, but purely elastic below a break-away deflection: does not drift";
  static constexpr ConstantList constants{&Constants::normal_stiffness,
                                          &Constants::normal_damping,
                                          &Constants::tangential_stiffness,
                                          &Constants::tangential_damping,
                                          &Constants::static_friction,
                                          &Constants::kinetic_friction,
                                          &Constants::stribeck_speed,
                                          &Constants::viscous_friction,
                                          &Constants::breakaway};
  static constexpr ConstantList own_constants{&Constants::breakaway};
  using RateForm = Elastoplastic;

  /// alpha(z, v), how plastic the motion is: 0 for k_t |z| up to breakaway mu_k N and where the
  /// bristle unbends (z.v <= 0), 1 from g(v) on, half a sine between.
  template <class Real>
  static Real plasticity(const LoadedBristle<Real>& bristle,
                         const MaterialConstants<Real>& material) {
    const Real bent = material.tangential_stiffness * norm(bristle.deflection);
    const Real elastic = material.breakaway * material.kinetic_friction * bristle.normal_force;
    const Real width = positive_or_one(Real(bristle.steady - elastic));
    const Real from_middle = (bent - 0.5 * (bristle.steady + elastic)) / width;
    const Real half_sine =
        0.5 +
        0.5 *
            sine_cosine(Real(std::numbers::pi * max(Real(-0.5), min(Real(0.5), from_middle)))).sine;
    const Mask<Real> bends = dot(bristle.deflection, bristle.velocity) > Real(0.);
    const Real below_steady = select(bent > elastic, half_sine, Real(0.));
    const Real bending = select(bristle.steady > bent, below_steady, Real(1.));
    return select(bends, bending, Real(0.));
  }

  /// Force on the robot, bristle rate and next memory of one point: N = max(0, k d + c d'),
  ///   z' = v - alpha(z, v) k_t |v| z/g(v),   f = k_t z + sigma1(v) z' + sigma2 v,   g = mu(v) N
  /// Only k_t z is within the cone; |f| <= 3 mu_s N + sigma2 |v|. O(1), pure, no branch on state.
  template <class Real>
  static Reaction<Real> evaluate(const PointKinematics<Real>& point, const Memory<Real>& /*memory*/,
                                 const MaterialConstants<Real>& material, const Real& dt) {
    const LoadedBristle<Real> bristle = loaded_bristle(point, material);
    return lugre_reaction(point, bristle, plasticity(bristle, material), material, dt);
  }

  /// Shift under a steady tangential load f [N] while only bending, f <= breakaway mu_k N: f/k_t
  /// [m]; above, none in closed form.
  static std::optional<double> stick_displacement(double load, double normal_load,
                                                  const MaterialConstants<double>& material) {
    if (load > material.breakaway * material.kinetic_friction * normal_load) return std::nullopt;
    return load / material.tangential_stiffness;
  }
};

}  // namespace hookpoint::contact
