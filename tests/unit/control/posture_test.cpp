// Posture control against a body that stands on its legs: a plane through feet of given lengths.
#include <gtest/gtest.h>

#include <array>
#include <cmath>
#include <memory>
#include <string>

#include "control/registry.h"
#include "tests/support/allocation_counter.h"

namespace hookpoint::testing {
namespace {

constexpr double dt = 0.01;
constexpr std::array<double, 6> foot_x{-0.15, 0., 0.15, -0.15, 0., 0.15};
constexpr std::array<double, 6> foot_y{-0.2, -0.25, -0.2, 0.2, 0.25, 0.2};

std::string leg(const char* name, std::size_t i) {
  return std::string(name) + "[" + std::to_string(i) + "]";
}

class Posture : public ::testing::Test {
 protected:
  Posture() {
    const control::ComponentClass* type = control::Registry::instance().find("Controller.Posture");
    component = type->make();
    for (std::size_t i = 0; i < 6; ++i) {
      value(leg("foot_x", i)) = foot_x[i];
      value(leg("foot_y", i)) = foot_y[i];
    }
    for (const char* name : {"height", "roll", "pitch"})
      component->set_driven(*control::find_value(*component, name), true);
  }
  double& value(const std::string& name) {
    return component->values()[*control::find_value(*component, name)];
  }
  void update() { component->update({double(count) * dt, dt, count}), ++count; }
  void measure(double height, double roll, double pitch) {
    value("height") = height;
    value("roll") = roll;
    value("pitch") = pitch;
  }

  std::unique_ptr<control::Component> component;
  std::int64_t count = 0;
};

TEST_F(Posture, FirstOutputIsProportional) {
  value("goal_height") = 0.1;
  value("height_p") = 0.5;
  value("tilt_p") = 0.4;
  measure(0.09, 0.02, -0.03);
  update();
  for (std::size_t i = 0; i < 6; ++i) {
    // Left side up: the left legs shorten; nose up: the front legs shorten.
    const double expected =
        0.5 * 0.01 - foot_y[i] * std::tan(0.4 * 0.02) - foot_x[i] * std::tan(0.4 * 0.03);
    EXPECT_NEAR(value(leg("height_offset", i)), expected, 1e-15);
  }
}

TEST_F(Posture, IntegralGrowsWithErrorAndTime) {
  value("goal_height") = 0.1;
  value("height_p") = 0.;
  value("height_i") = 2.;
  measure(0.095, 0., 0.);
  for (int k = 0; k <= 100; ++k) update();
  // 2/s of 5 mm for 100 periods of 10 ms.
  EXPECT_NEAR(value("height_offset[0]"), 2. * 0.005 * 1., 1e-12);
}

TEST_F(Posture, LevelsAndLiftsABodyOnItsLegs) {
  // The legs give way: the body is 8 mm too low, rolled by 3 deg and pitched by -2 deg at equal
  // lengths. Lengths follow at once, the plane through the hips' corrections tilts the body.
  const double sag = 0.008, roll = 0.0524, pitch = -0.0349;
  value("goal_height") = 0.1;
  measure(0.1 - sag, roll, pitch);
  double mean = 0., tilt_x = 0., tilt_y = 0.;
  for (int k = 0; k < 2000; ++k) {
    update();
    double sum = 0., x = 0., y = 0., xx = 0., yy = 0.;
    for (std::size_t i = 0; i < 6; ++i) {
      const double offset = value(leg("height_offset", i));
      sum += offset;
      x += foot_x[i] * offset;
      y += foot_y[i] * offset;
      xx += foot_x[i] * foot_x[i];
      yy += foot_y[i] * foot_y[i];
    }
    mean = sum / 6.;
    tilt_y = std::atan(-x / xx);
    tilt_x = std::atan(y / yy);
    measure(0.1 - sag + mean, roll + tilt_x, pitch + tilt_y);
  }
  EXPECT_NEAR(value("height"), 0.1, 1e-6);
  EXPECT_NEAR(value("roll"), 0., 1e-6);
  EXPECT_NEAR(value("pitch"), 0., 1e-6);
  EXPECT_NEAR(mean, sag, 1e-6);
}

TEST_F(Posture, LimitsHoldAndTheIntegralDoesNotWindUp) {
  value("goal_height") = 0.1;
  value("height_p") = 0.5;
  value("height_i") = 2.;
  value("height_limit") = 0.01;
  measure(0.05, 0., 0.);
  for (int k = 0; k < 1000; ++k) update();
  EXPECT_NEAR(value("height_offset[0]"), 0.01, 1e-15);
  // Once above the goal the output leaves the limit in the first update: nothing was stored beyond
  // it.
  measure(0.101, 0., 0.);
  update();
  EXPECT_LT(value("height_offset[0]"), 0.01);
}

TEST_F(Posture, WhatIsNotMeasuredIsNotControlled) {
  for (const char* name : {"height", "roll", "pitch"})
    component->set_driven(*control::find_value(*component, name), false);
  value("goal_height") = 0.1;
  update();
  for (std::size_t i = 0; i < 6; ++i) EXPECT_EQ(value(leg("height_offset", i)), 0.);
}

TEST_F(Posture, DampsRatesOfTilt) {
  value("tilt_p") = 0.4;
  value("tilt_d") = 0.05;
  measure(0., 0.02, -0.03);
  value("roll_rate") = 0.1;
  value("pitch_rate") = 0.2;
  for (const char* name : {"height", "roll_rate", "pitch_rate"})
    component->set_driven(*control::find_value(*component, name), name != std::string("height"));
  update();
  for (std::size_t i = 0; i < 6; ++i) {
    const double expected = -foot_y[i] * std::tan(0.4 * 0.02 + 0.05 * 0.1) -
                            foot_x[i] * std::tan(0.4 * 0.03 - 0.05 * 0.2);
    EXPECT_NEAR(value(leg("height_offset", i)), expected, 1e-15);
  }
}

TEST_F(Posture, OfFourLegsLeavesTheOthersAlone) {
  value("legs") = 4.;
  measure(0.09, 0.02, -0.03);
  update();
  EXPECT_NE(value("height_offset[3]"), 0.);
  EXPECT_EQ(value("height_offset[4]"), 0.);
}

TEST_F(Posture, UpdatesAllocateNothing) {
  measure(0.09, 0.02, -0.03);
  const long before = allocation_count();
  for (int k = 0; k < 1000; ++k) update();
  EXPECT_EQ(allocation_count(), before);
}

}  // namespace
}  // namespace hookpoint::testing
