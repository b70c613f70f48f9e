// Exact fractions: what a decimal meant, arithmetic against numbers worked by hand, overflow
// refused.
#include "control/core/rational.h"

#include <gtest/gtest.h>

#include <cmath>
#include <limits>
#include <stdexcept>

namespace hookpoint::control {
namespace {

constexpr std::int64_t greatest = std::numeric_limits<std::int64_t>::max();

void expect_fraction(double value, std::int64_t numerator, std::int64_t denominator) {
  const Rational fraction = Rational::from(value);
  EXPECT_EQ(fraction.numerator(), numerator) << value;
  EXPECT_EQ(fraction.denominator(), denominator) << value;
}

TEST(Rational, DecimalsAreWhatTheyMeant) {
  expect_fraction(0.001, 1, 1000);
  expect_fraction(0.02, 1, 50);
  expect_fraction(300., 300, 1);
  expect_fraction(0.1, 1, 10);
  expect_fraction(2.5e-4, 1, 4000);
  expect_fraction(123456.789, 123456789, 1000);
  expect_fraction(1. / 3., 1, 3);
  expect_fraction(1000. / 3., 1000, 3);
  expect_fraction(1e-15, 1, 1000000000000000);
  expect_fraction(-0.25, -1, 4);
  expect_fraction(0., 0, 1);
  expect_fraction(9007199254740991., 9007199254740991, 1);
  expect_fraction(0x1p62, std::int64_t{1} << 62, 1);
}

TEST(Rational, AnOperationInFloatingPointDoesNotHideIt) {
  expect_fraction(0.1 + 0.2, 3, 10);
  expect_fraction(1. / 0.003, 1000, 3);
  expect_fraction(3. * 0.001, 3, 1000);
}

TEST(Rational, EveryDecimalOfSixDigitsIsFound) {
  for (std::int64_t i = 1; i < 1000000; i += 37) {
    const Rational meant(i, 1000000);
    ASSERT_EQ(Rational::from(static_cast<double>(i) / 1e6), meant) << i;
  }
}

TEST(Rational, StaysWithinTwoUnitsOfTheLastPlace) {
  double value = 0.123456789;
  for (int i = 0; i < 2000; ++i) {
    value = 3.99 * value * (1. - value);  // the logistic map: numbers without a short fraction
    const double back = Rational::from(value).value();
    const double unit = std::nextafter(value, 2.) - value;
    ASSERT_LE(std::abs(back - value), 2. * unit + 1e-18) << i;
  }
}

TEST(Rational, ArithmeticIsExact) {
  EXPECT_EQ(Rational(1, 3) + Rational(1, 6), Rational(1, 2));
  EXPECT_EQ(Rational(1, 3) - Rational(1, 2), Rational(-1, 6));
  EXPECT_EQ(Rational(4, 9) * Rational(3, 2), Rational(2, 3));
  EXPECT_EQ(Rational(4, 9) / Rational(-2, 3), Rational(-2, 3));
  EXPECT_EQ(Rational(6, -4).numerator(), -3);
  EXPECT_EQ(Rational(6, -4).denominator(), 2);
  // Products beyond 64 bits on the way, a result within.
  EXPECT_EQ(Rational(greatest, 7) * Rational(7, greatest), Rational(1));
  EXPECT_LT(Rational(greatest - 1, greatest), Rational(1));
  EXPECT_GT(Rational(1), Rational(greatest - 1, greatest));
  EXPECT_FALSE(Rational(1, 2) < Rational(2, 4));
  EXPECT_LT(Rational(greatest - 2, greatest - 1), Rational(greatest - 1, greatest));
}

TEST(Rational, CeilingRoundsUp) {
  EXPECT_EQ(Rational(10, 3).ceiling(), 4);
  EXPECT_EQ(Rational(9, 3).ceiling(), 3);
  EXPECT_EQ(Rational(-10, 3).ceiling(), -3);
  EXPECT_EQ(Rational(0).ceiling(), 0);
}

TEST(Rational, RefusesWhatDoesNotFit) {
  EXPECT_THROW(Rational(greatest) * Rational(2), std::overflow_error);
  EXPECT_THROW(Rational(greatest) + Rational(1), std::overflow_error);
  EXPECT_THROW(Rational(1, greatest) * Rational(1, 2), std::overflow_error);
  EXPECT_THROW(Rational(1) / Rational(0), std::invalid_argument);
  EXPECT_THROW(Rational(1, 0), std::invalid_argument);
  EXPECT_THROW(Rational::from(std::nan("")), std::invalid_argument);
  EXPECT_THROW(Rational::from(INFINITY), std::invalid_argument);
  for (const double outside : {1e19, 0x1p63, 1e300, 1e-20, 1e-40, 1e-300}) {
    EXPECT_THROW(Rational::from(outside), std::overflow_error) << outside;
  }
}

}  // namespace
}  // namespace hookpoint::control
