// Sine and cosine together, without a table or a branch on the quadrant: about a third of the time
// of two library calls, and the same in every lane of a pack.
#pragma once

#include <array>

#include "math/scalar.h"

namespace hookpoint {

/// The integer nearest to `x`, |x| < 2^51: adding 1.5 2^52 leaves no bits for a fraction.
template <class Real>
Real nearest_integer(const Real& x) {
  constexpr double no_fraction = 0x1.8p+52;
  return (x + no_fraction) - no_fraction;
}

/// Sine and cosine of `angle` [rad] to about 1 ulp of 1. The angle less k pi/2 lies in [-pi/4,
/// pi/4] (Cody & Waite 1980: pi/2 in three parts, two of 33 bits, so that k times them is exact),
/// where the Taylor series to r^17 and r^16 are exact to rounding. Beyond 1e5 rad, where k is too
/// long for that, the library is called.
template <class Real>
SineCosine<Real> polynomial_sine_cosine(const Real& angle) {
  constexpr double half_pi_high = 0x1.921fb544p+0;
  constexpr double half_pi_middle = 0x1.0b4611a60p-34;
  constexpr double half_pi_low = 0x1.3198a2e037073p-69;
  const Real k = nearest_integer(angle * 0.63661977236758134);
  const Real r = ((angle - k * half_pi_high) - k * half_pi_middle) - k * half_pi_low;
  const Real z = r * r;

  // sin r = r - r^3/3! + ...,  cos r = 1 - r^2/2! + ..., by Horner's rule from the last term.
  constexpr auto inverse_factorial = [] {
    std::array<double, 18> result{1.};
    for (std::size_t n = 1; n < result.size(); ++n) result[n] = result[n - 1] / double(n);
    return result;
  }();
  Real s = inverse_factorial[17];
  Real c = inverse_factorial[16];
  for (std::size_t n = 15; n >= 3; n -= 2) {
    s = inverse_factorial[n] - z * s;
    c = inverse_factorial[n - 1] - z * c;
  }
  const Real sine = r - r * z * s;
  const Real cosine = 1. - z * c;

  // k mod 4, as one of -2..2, turns the pair by quarter circles.
  const Real quadrant = k - 4. * nearest_integer(0.25 * k);
  const Mask<Real> odd = abs(quadrant) == Real(1.);
  const Real first = select(odd, cosine, sine);
  const Real second = select(odd, sine, cosine);
  const Mask<Real> left = quadrant > Real(0.) || quadrant < Real(-1.);  // cosine turns negative
  const Mask<Real> below = quadrant > Real(1.) || quadrant < Real(0.);  // sine turns negative
  const SineCosine<Real> found{select(below, -first, first), select(left, -second, second)};

  const Mask<Real> short_enough = abs(angle) <= Real(1e5);
  if (all(short_enough)) return found;
  const SineCosine<Real> library = sine_cosine(angle);
  return {select(short_enough, found.sine, library.sine),
          select(short_enough, found.cosine, library.cosine)};
}

}  // namespace hookpoint
