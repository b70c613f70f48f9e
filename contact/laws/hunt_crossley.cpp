#include "contact/laws/hunt_crossley.h"

#include "math/bisect.h"

namespace hookpoint::contact {

std::optional<double> HuntCrossley::creep_speed(double tangent_of_slope,
                                                const MaterialConstants<double>& material) {
  if (tangent_of_slope <= 0.) return 0.;
  const double v_s = material.regularisation_speed;
  const auto excess = [&](double v) {
    return stribeck_friction(v, material) * friction_regularisation(v / v_s) - tangent_of_slope;
  };
  // Stribeck's drop makes friction rise and fall, so march outwards to the first crossing. Since
  // friction is at most max(mu) v/v_s, the root lies no nearer than `low`; past `last` the curve is
  // within rounding of mu_k phi(v/v_s).
  const double mu_max = max(material.static_friction, material.kinetic_friction);
  double last = 10. * material.stribeck_speed;
  if (tangent_of_slope < material.kinetic_friction) {
    const double kinetic_root =
        v_s * friction_regularisation_inverse(tangent_of_slope / material.kinetic_friction);
    last = max(last, 2. * kinetic_root);
  }
  double low = v_s * tangent_of_slope / mu_max;
  if (excess(low) >= 0.) return low;
  double high = low;
  while (excess(high) < 0.) {
    if (high > last) return std::nullopt;
    low = high;
    high *= 1.01;
  }
  return bisect(excess, low, high);
}

}  // namespace hookpoint::contact
