// Where a point came through the ground in a flight that has been flown.
#include "contact/impulse/gap_cubic.h"

#include <gtest/gtest.h>

#include <cmath>
#include <functional>

#include "contact/impulse/landing_time.h"

namespace hookpoint::contact {
namespace {

constexpr double kFloor = -1e-10;

GapCubic cubic(const std::function<double(double)>& gap, const std::function<double(double)>& rate,
               double h) {
  return {{gap(0.), rate(0.)}, {gap(h), rate(h)}, h};
}

TEST(GapCubic, ACubicIsMetExactly) {
  const auto gap = [](double t) { return 0.02 - 0.1 * t - 2. * t * t + 3. * t * t * t; };
  const auto rate = [](double t) { return -0.1 - 4. * t + 9. * t * t; };
  const GapCubic found = cubic(gap, rate, 0.2);
  for (const double t : {0., 0.03, 0.11, 0.2}) EXPECT_NEAR(found.at(t), gap(t), 1e-16);
  const double landing = found.landing(kFloor);
  EXPECT_NEAR(gap(landing), 0., 1e-15);
  EXPECT_LT(rate(landing), 0.);
}

TEST(GapCubic, APointThatLeavesIsMetWhereItComesBack) {
  const double u0 = 1e-3, g = 9.81;
  const auto gap = [&](double t) { return -3e-11 + u0 * t - 0.5 * g * t * t; };
  const auto rate = [&](double t) { return u0 - g * t; };
  EXPECT_NEAR(cubic(gap, rate, 5e-4).landing(kFloor), 2. * u0 / g, 1e-7);
}

TEST(GapCubic, ADipBetweenTwoEndsAboveTheGroundIsFound) {
  const auto gap = [](double t) { return (t - 0.3) * (t - 0.5); };
  const auto rate = [](double t) { return 2. * t - 0.8; };
  EXPECT_NEAR(cubic(gap, rate, 1.).landing(kFloor), 0.3, 1e-12);
  const auto above = [](double t) { return (t - 0.3) * (t - 0.5) + 0.011; };
  EXPECT_EQ(cubic(above, rate, 1.).landing(kFloor), 1.);
}

TEST(GapCubic, APointAtRestIsLetDownByAHair) {
  const double g = 9.81;
  const auto gap = [&](double t) { return -0.5 * g * t * t; };
  const auto rate = [&](double t) { return -g * t; };
  const GapCubic found = cubic(gap, rate, 1e-3);
  EXPECT_NEAR(found.at(found.landing(kFloor)), 0.5 * kFloor, 1e-14);
}

TEST(LandingTime, IsTheParabolas) {
  EXPECT_NEAR(landing_time(0.2, -1., 0., 0.), 0.2, 1e-16);
  EXPECT_NEAR(landing_time(0.2, 1., -10., 0.), (1. + std::sqrt(5.)) / 10., 1e-15);
  EXPECT_NEAR(landing_time(0., 1., -10., 0.), 0.2, 1e-16);
  EXPECT_NEAR(landing_time(0., 0., -10., 5e-13), std::sqrt(1e-13), 1e-20);
  EXPECT_TRUE(std::isinf(landing_time(0.2, -1., 10., 0.)));
  EXPECT_TRUE(std::isinf(landing_time(0.2, 1., 0., 0.)));
}

}  // namespace
}  // namespace hookpoint::contact
