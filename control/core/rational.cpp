#include "control/core/rational.h"

#include <cmath>
#include <limits>
#include <numeric>
#include <stdexcept>

namespace hookpoint::control {
namespace {

__extension__ using Wide = __int128;

constexpr Wide greatest = std::numeric_limits<std::int64_t>::max();

Wide greatest_common_divisor(Wide a, Wide b) {
  while (b != 0) {
    const Wide remainder = a % b;
    a = b;
    b = remainder;
  }
  return a < 0 ? -a : a;
}

Rational reduced(Wide numerator, Wide denominator) {
  if (denominator == 0) throw std::invalid_argument("division of an exact fraction by zero");
  if (denominator < 0) {
    numerator = -numerator;
    denominator = -denominator;
  }
  const Wide divisor = greatest_common_divisor(numerator, denominator);
  numerator /= divisor;
  denominator /= divisor;
  if (numerator > greatest || -numerator > greatest || denominator > greatest) {
    throw std::overflow_error("a rate, delay or step is too large or too small to be kept exactly");
  }
  return {static_cast<std::int64_t>(numerator), static_cast<std::int64_t>(denominator)};
}

Wide floor_of(Wide numerator, Wide denominator) {
  const Wide quotient = numerator / denominator;
  return numerator % denominator < 0 ? quotient - 1 : quotient;
}

/// mantissa 2^exponent, which is whole.
Rational whole_number(Wide mantissa, int exponent) {
  if (exponent > 11) return reduced(greatest + 1, 1);
  return reduced(exponent > 0 ? mantissa << exponent : mantissa >> -exponent, 1);
}

}  // namespace

Rational::Rational(std::int64_t numerator, std::int64_t denominator) {
  const std::int64_t divisor = std::gcd(numerator, denominator);
  if (denominator > 0 && divisor == 1) {
    numerator_ = numerator;
    denominator_ = denominator;
  } else {
    *this = reduced(numerator, denominator);
  }
}

Rational Rational::from(double value) {
  if (!std::isfinite(value)) {
    throw std::invalid_argument("a rate, delay or step is not a finite number");
  }
  if (value < 0.) return Rational(0) - from(-value);
  int exponent = 0;
  const Wide mantissa = static_cast<std::int64_t>(std::ldexp(std::frexp(value, &exponent), 53));
  exponent -= 53;
  if (value == std::floor(value)) return whole_number(mantissa, exponent);
  if (exponent < -120) return reduced(1, greatest + 1);
  // value = mantissa 2^exponent; two units of the mantissa to either side.
  Wide low = mantissa - 2, low_unit = Wide{1} << -exponent;
  Wide high = mantissa + 2, high_unit = low_unit;
  // The simplest fraction strictly between: both ends share the terms of their continued fractions
  // until an integer fits.
  Wide p = 1, q = 0, p_before = 0, q_before = 1;
  for (;;) {
    const Wide whole = floor_of(low, low_unit);
    const bool fits = high_unit == 0 || whole + 1 <= floor_of(high - 1, high_unit);
    const Wide term = fits ? whole + 1 : whole;
    const Wide p_next = term * p + p_before, q_next = term * q + q_before;
    if (fits) return reduced(p_next, q_next);
    p_before = p;
    q_before = q;
    p = p_next;
    q = q_next;
    // Reciprocals of what is left change places.
    const Wide low_rest = low - whole * low_unit, high_rest = high - whole * high_unit;
    low = high_unit;
    high = low_unit;
    low_unit = high_rest;
    high_unit = low_rest;
  }
}

std::int64_t Rational::ceiling() const {
  return static_cast<std::int64_t>(-floor_of(-Wide{numerator_}, denominator_));
}

Rational operator+(const Rational& a, const Rational& b) {
  return reduced(Wide{a.numerator_} * b.denominator_ + Wide{b.numerator_} * a.denominator_,
                 Wide{a.denominator_} * b.denominator_);
}
Rational operator-(const Rational& a, const Rational& b) {
  return reduced(Wide{a.numerator_} * b.denominator_ - Wide{b.numerator_} * a.denominator_,
                 Wide{a.denominator_} * b.denominator_);
}
Rational operator*(const Rational& a, const Rational& b) {
  return reduced(Wide{a.numerator_} * b.numerator_, Wide{a.denominator_} * b.denominator_);
}
Rational operator/(const Rational& a, const Rational& b) {
  return reduced(Wide{a.numerator_} * b.denominator_, Wide{a.denominator_} * b.numerator_);
}
std::strong_ordering operator<=>(const Rational& a, const Rational& b) {
  return Wide{a.numerator_} * b.denominator_ <=> Wide{b.numerator_} * a.denominator_;
}

}  // namespace hookpoint::control
