// Exact fractions, in which rates, delays and steps are kept: 300 Hz on a step of 1 ms is 10/3 of a
// step a sample, and no error accumulates however long the run.
#pragma once

#include <compare>
#include <cstdint>

namespace hookpoint::control {

/// A fraction in lowest terms with a positive denominator. Arithmetic is exact; a result whose
/// numerator or denominator does not fit 64 bits throws std::overflow_error, a zero denominator
/// std::invalid_argument.
class Rational {
 public:
  Rational() = default;
  Rational(std::int64_t numerator,
           std::int64_t denominator = 1);  // NOLINT(google-explicit-constructor)

  /// The fraction that the writer of `value` meant: of all within two units of its last place,
  /// which is what reading a decimal and an operation or two can leave, the one with the smallest
  /// denominator (0.001 -> 1/1000, 1/3. -> 1/3, 0.1 + 0.2 -> 3/10); a whole number is itself.
  /// Throws std::invalid_argument when `value` is not finite, std::overflow_error outside of 64
  /// bits. Source: Graham, Knuth & Patashnik, Concrete Mathematics, 2nd ed., section 4.5 (simplest
  /// fraction of an interval).
  static Rational from(double value);

  std::int64_t numerator() const { return numerator_; }
  std::int64_t denominator() const { return denominator_; }
  double value() const {
    return static_cast<double>(numerator_) / static_cast<double>(denominator_);
  }
  /// The least integer that is not less.
  std::int64_t ceiling() const;

  friend Rational operator+(const Rational& a, const Rational& b);
  friend Rational operator-(const Rational& a, const Rational& b);
  friend Rational operator*(const Rational& a, const Rational& b);
  friend Rational operator/(const Rational& a, const Rational& b);
  friend bool operator==(const Rational&, const Rational&) = default;
  friend std::strong_ordering operator<=>(const Rational& a, const Rational& b);

 private:
  std::int64_t numerator_ = 0, denominator_ = 1;
};

}  // namespace hookpoint::control
