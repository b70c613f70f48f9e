#include "contact/predictions.h"

#include <limits>

#include "math/bisect.h"

namespace hookpoint::contact {

bool holds_on_slope(double tangent_of_slope, double static_friction) {
  return tangent_of_slope <= static_friction;
}

double slip_acceleration(double gravity, double angle, double kinetic_friction) {
  return gravity * (std::sin(angle) - kinetic_friction * std::cos(angle));
}

double braking_distance(double speed, double gravity, double kinetic_friction) {
  return speed * speed / (2. * kinetic_friction * gravity);
}

double braking_elastic_offset(double load, const MaterialConstants<double>& material) {
  return material.kinetic_friction * load / material.tangential_stiffness;
}

double kelvin_voigt_restitution(double damping_ratio) {
  const double zeta = damping_ratio;
  const double discriminant = 1. - zeta * zeta;
  // acos(2 zeta^2 - 1) = 2 asin(sqrt(1 - zeta^2)); both branches tend to exp(-2) at zeta = 1, where
  // they are 0/0.
  if (std::abs(discriminant) < 1e-12) return std::exp(-2.);
  const double root = std::sqrt(std::abs(discriminant));
  const double angle =
      discriminant > 0. ? std::acos(2. * zeta * zeta - 1.) : std::acosh(2. * zeta * zeta - 1.);
  return std::exp(-zeta / root * angle);
}

double kelvin_voigt_damping_ratio(double restitution) {
  if (restitution >= 1.) return 0.;
  if (restitution <= 0.) return std::numeric_limits<double>::infinity();
  double high = 1.;
  while (kelvin_voigt_restitution(high) > restitution) high *= 2.;
  return bisect([&](double zeta) { return restitution - kelvin_voigt_restitution(zeta); }, 0.,
                high);
}

double hunt_crossley_restitution(double alpha_times_speed) {
  const double a = alpha_times_speed;
  // Below, the energies a - ln(1 + a) ~ a^2/2 cancel; their series gives e = 1 - 2a/3 + O(a^2).
  if (a < 1e-5) return 1. - 2. / 3. * a;
  const double energy_in = a - std::log1p(a);
  const double upper = a < 1. ? 1. : 1. / a;
  return bisect([&](double e) { return -e * a - std::log1p(-e * a) - energy_in; }, 0., upper);
}

double hook_survival_speed(double gravity, double mass, double total_normal_stiffness) {
  return gravity * std::sqrt(mass / total_normal_stiffness);
}

}  // namespace hookpoint::contact
