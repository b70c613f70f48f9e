// Sine and cosine together, without a table or a branch on the quadrant: about a third of the time
// of two library calls.
#pragma once

#include <array>

#include "math/scalar.h"

namespace hookpoint {

/// Sine and cosine of `angle` [rad] to about 1 ulp of 1. The angle less k pi/2 lies in [-pi/4,
/// pi/4] (Cody & Waite 1980, with pi/2 in two parts and fused products), where the Taylor series to
/// r^17 and r^16 are exact to rounding. Beyond 1e5 rad, where two parts of pi/2 no longer do, the
/// library is asked.
inline SineCosine<double> polynomial_sine_cosine(double angle) {
  if (!(std::abs(angle) <= 1e5)) return sine_cosine(angle);
  constexpr double half_pi_high = 0x1.921fb54442d18p+0;
  constexpr double half_pi_low = 0x1.1a62633145c07p-54;
  constexpr double round_to_integer = 0x1.8p+52;  // adding it leaves no bits for a fraction
  const double shifted = angle * 0.63661977236758134 + round_to_integer;
  const double k = shifted - round_to_integer;
  const double r = std::fma(-k, half_pi_low, std::fma(-k, half_pi_high, angle));
  const double z = r * r;

  // sin r = r - r^3/3! + ...,  cos r = 1 - r^2/2! + ..., by Horner's rule from the last term.
  constexpr auto inverse_factorial = [] {
    std::array<double, 18> result{1.};
    for (std::size_t n = 1; n < result.size(); ++n) result[n] = result[n - 1] / double(n);
    return result;
  }();
  double s = inverse_factorial[17];
  double c = inverse_factorial[16];
  for (std::size_t n = 15; n >= 3; n -= 2) {
    s = inverse_factorial[n] - z * s;
    c = inverse_factorial[n - 1] - z * c;
  }
  const double sine = r - r * z * s;
  const double cosine = 1. - z * c;

  // k mod 4 turns the pair by quarter circles.
  const int quadrant = int(k) & 3;
  const bool odd = (quadrant & 1) != 0;
  const double first = select(odd, cosine, sine);
  const double second = select(odd, sine, cosine);
  return {select((quadrant & 2) != 0, -first, first),
          select(((quadrant + 1) & 2) != 0, -second, second)};
}

}  // namespace hookpoint
