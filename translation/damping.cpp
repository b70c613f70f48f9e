#include "translation/damping.h"

#include <cmath>

#include "contact/predictions.h"
#include "math/bisect.h"

namespace hookpoint::translation {
namespace {

/// Where `restitution`, which falls from 1, is `e`.
template <class Function>
double damping_for(double e, Function restitution) {
  double high = 1.;
  while (restitution(high) > e && high < 1e12) high *= 2.;
  return bisect([&](double damping) { return e - restitution(damping); }, 0., high);
}

/// The energy at the deepest point comes back: e = exp(-z/s acos z), s = sqrt(1 - z^2), and its
/// continuation beyond a damping ratio z of 1.
double one_sided_restitution(double zeta) {
  const double root = std::sqrt(std::abs(1. - zeta * zeta));
  if (root < 1e-6) return std::exp(-1.);
  return std::exp(-zeta / root * (zeta < 1. ? std::acos(zeta) : std::acosh(zeta)));
}

double critical_damping(const DesiredContact& desired, const Situation& at) {
  return 2. * std::sqrt(desired.stiffness * at.mass);
}

}  // namespace

double desired_rebound(const DesiredContact& desired, const Situation& at) {
  return contact::kelvin_voigt_restitution(desired.damping / critical_damping(desired, at));
}

double hunt_crossley_damping(const DesiredContact& desired, const Situation& at) {
  return damping_for(desired_rebound(desired, at), contact::hunt_crossley_restitution) /
         impact_speed;
}

double one_sided_damping(const DesiredContact& desired, const Situation& at) {
  return damping_for(desired_rebound(desired, at), one_sided_restitution) *
         critical_damping(desired, at);
}

}  // namespace hookpoint::translation
