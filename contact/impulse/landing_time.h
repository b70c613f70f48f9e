// When a point in flight comes down, by the quadratic of its gap.
#pragma once

#include <cmath>
#include <limits>

namespace hookpoint::contact {

/// The time at which gap + rate t + acceleration t^2/2 comes down to zero [s]; infinity if it never
/// does. A point that touches and leaves is awaited where it comes back, also if rounding left it a
/// little inside. A point at rest on the plane falls a hair, `sink` [m], to be hit there.
inline double landing_time(double gap, double rate, double acceleration, double sink) {
  constexpr double never = std::numeric_limits<double>::infinity();
  double discriminant = rate * rate - 2. * acceleration * gap;
  if (gap <= 0.) {
    if (acceleration >= 0.) return never;
    if (rate <= 0.) return std::sqrt(2. * sink / -acceleration);
    if (discriminant < 0.) discriminant = rate * rate;
    return (rate + std::sqrt(discriminant)) / -acceleration;
  }
  if (discriminant < 0.) return never;
  const double root = std::sqrt(discriminant);
  if (rate < 0.) return 2. * gap / (root - rate);
  return acceleration < 0. ? (rate + root) / -acceleration : never;
}

}  // namespace hookpoint::contact
