// The exponential spring of Anderson & Pandy (1999), with the sliding state that its later open
// description gives it (Simbody, class ExponentialSpringForce): a normal force that is never quite
// 0, so that touch-down is no event, and an anchored tangential spring-damper whose coefficient of
// friction goes smoothly from static to kinetic.
#pragma once

#include "contact/laws/clipped_bristle.h"

namespace hookpoint::contact {

struct Exponential {
  static constexpr const char* name = "exponential";
  static constexpr const char* source = "Anderson & Pandy 1999";
  static constexpr const char* summary =
      "d1 exp(-d2 (z - d0)) (1 - c z'); anchored spring, friction from static to kinetic by a "
      "sliding state";
  static constexpr ConstantList constants{
      &Constants::exponential_force,    &Constants::exponential_rate,
      &Constants::exponential_height,   &Constants::hysteresis_damping,
      &Constants::tangential_stiffness, &Constants::tangential_damping,
      &Constants::static_friction,      &Constants::kinetic_friction,
      &Constants::stribeck_speed,       &Constants::sliding_time};
  static constexpr ConstantList own_constants{
      &Constants::exponential_force, &Constants::exponential_rate, &Constants::hysteresis_damping,
      &Constants::sliding_time};
  static constexpr NormalConstants normal_constants{&Constants::exponential_rate, "1/m",
                                                    &Constants::hysteresis_damping};
  using RateForm = Exponential;
  static constexpr std::size_t bristle_states = 4;

  /// The law is cut off where its spring is a millionth of d1 [m]: d0 + ln(1e6)/d2 above the tile.
  template <class Real>
  static Real reach(const MaterialConstants<Real>& material) {
    return material.exponential_height + ln_million / material.exponential_rate;
  }

  /// N = max(0, d1 exp(d2 (d + d0)) (1 + c d')), height z = -d [N].
  template <class Real>
  static Real normal_force(const Real& depth, const Real& depth_rate,
                           const MaterialConstants<Real>& material) {
    return spring_force(depth, material) *
           max(Real(0.), 1. + material.hysteresis_damping * depth_rate);
  }

  /// Force on the robot, bristle rate and next memory of one point; friction by clipped_bristle
  /// (the deflection is the point's distance from its anchor) with
  ///   mu = mu_s - S (mu_s - mu_k)
  ///   S' = (1 - S)/tau while it slips,  -S/tau while it does not and |v| < v_St,  else 0
  /// S no faster than in a step `dt` [s]. Needs tau > 0. O(1), pure, no
  /// branch on state.
  template <class Real>
  static Reaction<Real> evaluate(const PointKinematics<Real>& point, const Memory<Real>& /*memory*/,
                                 const MaterialConstants<Real>& material, const Real& dt) {
    const Mask<Real> inside = point.depth > -reach(material);
    const Real N = normal_force(point.depth, Real(-dot(point.velocity, point.normal)), material);
    const Real S = max(Real(0.), min(Real(1.), point.bristle.sliding));
    const Real mu =
        material.static_friction - S * (material.static_friction - material.kinetic_friction);
    const Vector3<Real> u = tangential(point.bristle.deflection, point.normal);
    const BristleFriction<Real> friction = clipped_bristle(point, u, material, Real(mu * N), dt);

    const Mask<Real> settled =
        material.stribeck_speed > norm(tangential(point.velocity, point.normal));
    const Real towards_rest = select(settled, -S, Real(0.));
    const Real rate = select(friction.slips, 1. - S, towards_rest) / max(material.sliding_time, dt);
    Reaction<Real> reaction = bristle_reaction(point, inside, N, u, friction);
    reaction.bristle.sliding = select(inside, S, Real(0.));
    reaction.bristle_rate.sliding = select(inside, rate, Real(0.));
    return reaction;
  }

  /// Penetration under a steady normal load [N] on one point: ln(N/d1)/d2 - d0 [m]; below 0 the
  /// point hovers.
  static double static_depth(double load, const MaterialConstants<double>& material) {
    return std::log(load / material.exponential_force) / material.exponential_rate -
           material.exponential_height;
  }
  /// Shift of a sticking point under a steady tangential load [N]: f/k_t [m].
  static std::optional<double> stick_displacement(double load, double /*normal_load*/,
                                                  const MaterialConstants<double>& material) {
    return load / material.tangential_stiffness;
  }
  /// An anchored spring holds within the cone: 0 [m/s]; none beyond, where the point slides away.
  static std::optional<double> creep_speed(double tangent_of_slope,
                                           const MaterialConstants<double>& material) {
    return holds_on_slope(tangent_of_slope, material.static_friction) ? std::optional(0.)
                                                                      : std::nullopt;
  }
  /// Rebound speed over impact speed at `speed` [m/s], no gravity: Hunt & Crossley's, whose energy
  /// balance holds for any spring that the damping multiplies; independent of the mass [kg].
  static double restitution(double /*mass*/, double speed,
                            const MaterialConstants<double>& material) {
    return hunt_crossley_restitution(material.hysteresis_damping * speed);
  }
  /// Stiffness and damping about rest under a load N [N]: d2 N, c N, k_t, c_t.
  static LinearContact linearise(double load, const MaterialConstants<double>& material) {
    return {material.exponential_rate * load, material.hysteresis_damping * load,
            material.tangential_stiffness, material.tangential_damping};
  }
  /// Energy in the springs of a point within reach, (d1/d2) exp(d2 (d + d0)) + k_t u^2/2 less what
  /// the spring has at the reach [J].
  static double stored_energy(double depth, const Vector3d& stretch,
                              const MaterialConstants<double>& material) {
    const double within = max(-reach(material), depth);
    const double normal = spring_force(within, material) - spring_force(-reach(material), material);
    return normal / material.exponential_rate +
           0.5 * material.tangential_stiffness * dot(stretch, stretch);
  }
  /// As azad_featherstone's [m/s].
  static double resolved_speed(double /*load*/, double dt,
                               const MaterialConstants<double>& material) {
    return clipped_bristle_resolved(dt, material);
  }
  static double switching_value(const PointKinematics<double>& point, const Memory<double>& memory,
                                const Constants& /*material*/) {
    return slip_reversal(point, memory);
  }
  static bool slides_after(bool /*falling*/, const Memory<double>& memory,
                           const Constants& /*material*/) {
    return memory.sliding;
  }

 private:
  static constexpr double ln_million = 13.815510557964274;

  template <class Real>
  static Real spring_force(const Real& depth, const MaterialConstants<Real>& material) {
    using std::exp;
    return material.exponential_force *
           exp(material.exponential_rate * (depth + material.exponential_height));
  }
};

}  // namespace hookpoint::contact
