#include "math/sine_cosine.h"

#include <gtest/gtest.h>

#include <limits>
#include <random>

namespace hookpoint {
namespace {

void expect_ulp(double angle) {
  const SineCosine<double> found = polynomial_sine_cosine(angle);
  EXPECT_NEAR(found.sine, std::sin(angle), 2.3e-16) << angle;
  EXPECT_NEAR(found.cosine, std::cos(angle), 2.3e-16) << angle;
}

TEST(SineCosine, AgreesWithTheLibraryToRounding) {
  std::mt19937_64 engine(5);
  for (const double range : {1e-3, 1., 10., 1000., 1e5, 1e9}) {
    std::uniform_real_distribution<double> angles(-range, range);
    for (int i = 0; i < 20000; ++i) expect_ulp(angles(engine));
  }
}

TEST(SineCosine, AtMultiplesOfAQuarterCircle) {
  const double quarter = std::acos(0.);
  for (int k = 1; k <= 1000; ++k) {
    const SineCosine<double> found = polynomial_sine_cosine(k * quarter);
    // The small one of the two must be right in its leading digits as well.
    EXPECT_NEAR(found.sine / std::sin(k * quarter), 1., 1e-9) << k;
    EXPECT_NEAR(found.cosine / std::cos(k * quarter), 1., 1e-9) << k;
  }
}

TEST(SineCosine, NotFiniteStaysSo) {
  EXPECT_TRUE(std::isnan(polynomial_sine_cosine(std::numeric_limits<double>::infinity()).sine));
  EXPECT_TRUE(std::isnan(polynomial_sine_cosine(std::numeric_limits<double>::quiet_NaN()).cosine));
  EXPECT_EQ(polynomial_sine_cosine(0.).sine, 0.);
  EXPECT_EQ(polynomial_sine_cosine(0.).cosine, 1.);
}

}  // namespace
}  // namespace hookpoint
