// Azad & Featherstone's contact (2010): a normal force whose spring and damper both grow with the
// penetration as a sphere's on a plane do, and a tangential bristle that slips at the cone.
#pragma once

#include "contact/laws/clipped_bristle.h"
#include "contact/laws/impact.h"

namespace hookpoint::contact {

struct AzadFeatherstone {
  static constexpr const char* name = "azad_featherstone";
  static constexpr const char* source = "Azad & Featherstone 2010";
  static constexpr const char* summary =
      "max(0, k d^1.5 + D d^0.5 d'); a bristle as a continuous state, clipped at the cone";
  static constexpr ConstantList constants{
      &Constants::normal_stiffness,   &Constants::normal_damping,  &Constants::tangential_stiffness,
      &Constants::tangential_damping, &Constants::static_friction, &Constants::kinetic_friction};
  static constexpr ConstantList own_constants{};
  static constexpr NormalConstants normal_constants{&Constants::normal_stiffness, "N/m^1.5",
                                                    &Constants::normal_damping};
  using RateForm = AzadFeatherstone;
  static constexpr std::size_t bristle_states = 3;
  static double reach(const MaterialConstants<double>& /*material*/) { return 0.; }

  /// N = max(0, k d^1.5 + D d^0.5 d') inside the ground, 0 outside [N].
  template <class Real>
  static Real normal_force(const Real& depth, const Real& depth_rate,
                           const MaterialConstants<Real>& material) {
    const Real inside = max(Real(0.), depth);
    return sqrt(inside) *
           max(Real(0.), material.normal_stiffness * inside + material.normal_damping * depth_rate);
  }

  /// Force on the robot, bristle rate and next memory of one point; friction by
  /// stick_slip_reaction. O(1), pure, no branch on state.
  template <class Real>
  static Reaction<Real> evaluate(const PointKinematics<Real>& point, const Memory<Real>& memory,
                                 const MaterialConstants<Real>& material, const Real& dt) {
    return stick_slip_reaction(
        point, memory, material, dt,
        normal_force(point.depth, Real(-dot(point.velocity, point.normal)), material));
  }

  /// Penetration under a steady normal load [N] on one point: (N/k)^(2/3) [m].
  static double static_depth(double load, const MaterialConstants<double>& material) {
    return std::pow(load / material.normal_stiffness, 2. / 3.);
  }
  /// Shift of a sticking point under a steady tangential load [N]: f/k_t [m].
  static std::optional<double> stick_displacement(double load, double /*normal_load*/,
                                                  const MaterialConstants<double>& material) {
    return load / material.tangential_stiffness;
  }
  /// A bristle holds within the cone: 0 [m/s]; none beyond, where the point slides away.
  static std::optional<double> creep_speed(double tangent_of_slope,
                                           const MaterialConstants<double>& material) {
    return holds_on_slope(tangent_of_slope, material.static_friction) ? std::optional(0.)
                                                                      : std::nullopt;
  }
  /// Rebound speed over impact speed of a mass [kg] at `speed` [m/s], no gravity; no closed form,
  /// integrated from the law's equations.
  static double restitution(double mass, double speed, const MaterialConstants<double>& material) {
    return integrated_restitution(
        [&](double depth, double rate) { return normal_force(depth, rate, material); },
        [&](double depth) { return stored_energy(depth, {}, material); }, mass, speed);
  }
  /// Stiffness and damping about rest under a load [N]: 1.5 k d^0.5, D d^0.5, k_t, c_t.
  static LinearContact linearise(double load, const MaterialConstants<double>& material) {
    const double root = std::sqrt(static_depth(load, material));
    return {1.5 * material.normal_stiffness * root, material.normal_damping * root,
            material.tangential_stiffness, material.tangential_damping};
  }
  /// Energy in the springs of a point, 2/5 k d^2.5 + k_t u^2/2 [J].
  static double stored_energy(double depth, const Vector3d& stretch,
                              const MaterialConstants<double>& material) {
    const double inside = max(0., depth);
    return 0.4 * material.normal_stiffness * inside * inside * std::sqrt(inside) +
           0.5 * material.tangential_stiffness * dot(stretch, stretch);
  }
  /// u relaxes in c_t/k_t whatever the speed: a step below that resolves it, one above does not
  /// [m/s].
  static double resolved_speed(double /*load*/, double dt,
                               const MaterialConstants<double>& material) {
    return clipped_bristle_resolved(dt, material);
  }
  static double switching_value(const PointKinematics<double>& point, const Memory<double>& memory,
                                const Constants& material) {
    const double depth_rate = -dot(point.velocity, point.normal);
    return stick_slip_switching_value(point, memory, material,
                                      normal_force(point.depth, depth_rate, material));
  }
  static bool slides_after(bool falling, const Memory<double>& memory, const Constants& material) {
    return stick_slip_slides_after(falling, memory, material);
  }
};

}  // namespace hookpoint::contact
