// Controller.PD and Controller.PID against closed forms, and what controllers say of themselves
// against what they do.
#include <gtest/gtest.h>

#include <cmath>

#include "tests/support/linear_form.h"

namespace hookpoint {
namespace {

using testing::ComponentBench;

TEST(PD, IsProportionalToTheErrorAndTheWiredRate) {
  ComponentBench pd("Controller.PD");
  pd["goal"] = 0.5;
  pd["pconstant"] = 60.;
  pd["dconstant"] = 12.;
  pd["current"] = 0.75;
  pd.drive("rate_in", -0.125);
  pd.start();
  pd.tick();
  EXPECT_DOUBLE_EQ(pd["output"], 60. * (0.5 - 0.75) - 12. * -0.125);
}

TEST(PD, TakesTheRateFromSuccessiveSamplesWhenNoneIsWired) {
  ComponentBench pd("Controller.PD", 0.25);
  pd["dconstant"] = 3.;
  pd["rate_in"] = 99.;  // not wired: its value means nothing
  pd.start();
  pd["current"] = 7.;
  pd.tick();
  EXPECT_EQ(pd["output"], 0.);  // one sample has no rate
  pd["current"] = 7.5;
  pd.tick();
  EXPECT_EQ(pd["output"], -3. * 2.);
  pd.tick();
  EXPECT_EQ(pd["output"], 0.);
}

TEST(PD, AGoalThatStepsMakesNoKick) {
  ComponentBench pd("Controller.PD");
  pd["dconstant"] = 1e3;
  pd.start();
  pd.tick();
  pd["goal"] = 1.;
  pd.tick();
  EXPECT_EQ(pd["output"], 0.);
}

/// The plant y' = (u - y)/tau between samples of u held for T is y+ = a y + (1 - a) u, a =
/// exp(-T/tau). An integral gain of kp (1 - a)/T puts the controller's zero on that pole, and what
/// remains is the error e_k = (1 - kp (1 - a))^k.
TEST(PID, StepResponseOfAFirstOrderPlant) {
  const double period = 0.01, a = std::exp(-period / 0.2), kp = 3.;
  ComponentBench pid("Controller.PID", period);
  pid["goal"] = 1.;
  pid["pconstant"] = kp;
  pid["iconstant"] = kp * (1. - a) / period;
  pid.start();
  double y = 0.;
  for (int k = 0; k < 200; ++k) {
    EXPECT_NEAR(1. - y, std::pow(1. - kp * (1. - a), k), 1e-13) << k;
    pid["current"] = y;
    pid.tick();
    y = a * y + (1. - a) * pid["output"];
  }
}

/// A low-pass filter of backward differences with constant Tf sees the rate 1 of a ramp as 1 -
/// (Tf/(Tf + T))^k.
TEST(PID, FiltersTheDerivative) {
  const double period = 0.01, filter_time = 0.03;
  ComponentBench pid("Controller.PID", period);
  pid["dconstant"] = 1.;
  pid["filter_time"] = filter_time;
  pid.start();
  for (int k = 0; k < 50; ++k) {
    pid["current"] = k * period;
    pid.tick();
    EXPECT_NEAR(pid["output"], -(1. - std::pow(filter_time / (filter_time + period), k)), 1e-12);
  }
}

TEST(PID, UsesTheWiredRateUnfilteredWithoutAFilter) {
  ComponentBench pid("Controller.PID");
  pid["dconstant"] = 2.;
  pid.drive("rate_in", 3.);
  pid.start();
  pid.tick();
  EXPECT_EQ(pid["output"], -6.);
  pid["rate_in"] = 5.;
  pid.tick();
  EXPECT_DOUBLE_EQ(pid["output"], -10.);
}

TEST(PID, StaysWithinItsLimitsAndDoesNotWindUp) {
  ComponentBench pid("Controller.PID", 0.01);
  pid["goal"] = 10.;
  pid["pconstant"] = 1.;
  pid["iconstant"] = 1.;
  pid["output_min"] = -3.;
  pid["output_max"] = 2.;
  pid.start();
  pid.tick(1000);
  EXPECT_EQ(pid["output"], 2.);
  EXPECT_EQ(pid["integral"], 0.);
  pid["goal"] = -10.;
  pid.tick(1000);
  EXPECT_EQ(pid["output"], -3.);
  EXPECT_EQ(pid["integral"], 0.);
  // Beyond a limit it still integrates towards the inside: no deadlock.
  pid["integral"] = 15.;
  pid["goal"] = -1.;
  pid.tick();
  EXPECT_EQ(pid["output"], 2.);
  EXPECT_DOUBLE_EQ(pid["integral"], 15. - 0.01);
}

TEST(PID, RefusesCrossedLimits) {
  ComponentBench pid("Controller.PID");
  pid["output_min"] = 1.;
  pid["output_max"] = -1.;
  EXPECT_EQ(testing::start_error(pid), "output_min is above output_max");
}

/// Of a controller that is on the bench with all its gains.
void expect_linear_form(ComponentBench& bench, double period) {
  bench.start();
  EXPECT_LT(testing::linear_form_error(bench, period), 1e-12);
}

TEST(LinearForm, IsWhatAPdDoes) {
  for (const bool wired : {true, false}) {
    ComponentBench pd("Controller.PD", 2e-3);
    pd["pconstant"] = 60.;
    pd["dconstant"] = 0.7;
    if (wired) pd.drive("rate_in", 0.);
    expect_linear_form(pd, 2e-3);
  }
}

TEST(LinearForm, IsWhatAPidDoes) {
  for (const bool wired : {true, false}) {
    for (const double filter_time : {0., 5e-3}) {
      ComponentBench pid("Controller.PID", 2e-3);
      pid["pconstant"] = 60.;
      pid["iconstant"] = 900.;
      pid["dconstant"] = 0.7;
      pid["filter_time"] = filter_time;
      if (wired) pid.drive("rate_in", 0.);
      expect_linear_form(pid, 2e-3);
    }
  }
}

TEST(LinearForm, IsWhatEveryJointOfAJointPdDoes) {
  ComponentBench pd("Controller.JointPD", 2e-3);
  for (const int kind : {0, 1, 2}) {
    pd["pconstant[" + std::to_string(kind) + "]"] = 20. + kind;
    pd["dconstant[" + std::to_string(kind) + "]"] = 0.2 + 0.1 * kind;
  }
  EXPECT_EQ(pd.component().linearise().size(), 18u);
  expect_linear_form(pd, 2e-3);
}

TEST(LinearForm, IsNotSaidByWhatSaysNothing) {
  EXPECT_TRUE(ComponentBench("Gain").component().linearise().empty());
}

}  // namespace
}  // namespace hookpoint
