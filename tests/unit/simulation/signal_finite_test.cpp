// A number that is no longer finite stops a run as a state that is no longer finite does, wherever
// it comes up; and noise is every source's own.
#include <gtest/gtest.h>

#include <cmath>
#include <string>

#include "tests/support/run_text.h"

namespace hookpoint {
namespace {

using simulation::StepStatus;

std::string falling(const std::string& world, const std::string& rest) {
  return "World w { gravity = 9.81; deltat = 1 ms; " + world +
         " Robot ball { Base.mobile { location = 0, 0, 100; mass = 1; inertia = 1,1,1,0,0,0; } } "
         "Force push { body = ball.base; } }\n" +
         rest;
}

/// The step that fails, or the last of 20.
StepStatus failure(Running& run) {
  for (int i = 0; i < 20; ++i) {
    const StepStatus status = run.world().step();
    if (!status.ok()) return status;
  }
  return {};
}

void expect_stopped(const std::string& rest, const std::string& trail) {
  SCOPED_TRACE(rest);
  Running run(falling("", rest));
  const StepStatus status = failure(run);
  EXPECT_EQ(status.kind, StepStatus::Kind::not_finite);
  EXPECT_EQ(status.body, trail);
}

TEST(NotFinite, SignalsStopTheRun) {
  expect_stopped("Gain g { gain = 1e308; Wire FROM w.ball.position.z TO input; }", "g.output");
  expect_stopped("Signal.Sine s { amplitude = 1e308; offset = 1.7e308; phase = 90 deg; }",
                 "s.output");
  expect_stopped("Signal.Sine s { frequency = 1e308; amplitude = 1; }", "s.output");
  expect_stopped("Probe p { Wire FROM w.ball.velocity.z TO input { noise = 1.7e308; } }",
                 "p.input");
  expect_stopped(
      "Gain g { gain = 1e308; Wire FROM w.ball.position.z TO input; Wire TO w.push.force.x; }",
      "w.push.force.x");
}

TEST(NotFinite, TellsTheMomentOfTimeZeroToo) {
  Running run(falling("", "Gain g { gain = 1e308; Wire FROM w.ball.position.z TO input; }"));
  const StepStatus status = run.world().step();
  EXPECT_EQ(status.kind, StepStatus::Kind::not_finite);
  EXPECT_EQ(status.time, 0.);
  EXPECT_EQ(run.world().state().step, 0);
}

TEST(NotFinite, WhatIsWorkedOutStopsTheRunOnceItIsRead) {
  const std::string fast =
      "World w { gravity = 0; deltat = 1 ms; Robot ball { Base.mobile { velocity = 1e200, 0, 0; "
      "mass "
      "= 1; inertia = 1,1,1,0,0,0; } } }";
  Running unread(fast), read(fast);
  EXPECT_TRUE(failure(unread).ok());
  read.port("ball.kinetic_energy");
  EXPECT_EQ(failure(read).body, "w.ball.kinetic_energy");
}

TEST(NotFinite, OrdinarySignalsGoOn) {
  Running run(falling("",
                      "Gain g { gain = 1e300; Wire FROM w.ball.position.z TO input; } Probe p { "
                      "Wire FROM w.ball.velocity.z TO input { noise = 1; } }"));
  EXPECT_TRUE(failure(run).ok());
}

TEST(NoiseSources, AreIndependentAndFollowTheWorldsSeed) {
  const std::string two = "Signal.Noise a {} Signal.Noise b {}";
  Running run(falling("", two)), again(falling("", two)), other(falling("seed = 2;", two)),
      seeded(falling("", "Signal.Noise a { seed = 5; } Signal.Noise b {}"));
  const std::vector<double> a = run.record("a.output", 50);
  EXPECT_EQ(a, again.record("a.output", 50));
  EXPECT_NE(a, other.record("a.output", 50));
  EXPECT_NE(a, seeded.record("a.output", 50));
  Running side(falling("", two));
  for (int i = 0; i < 50; ++i) {
    EXPECT_NE(side["a.output"], side["b.output"]);
    side.step();
  }
}

TEST(InertialUnit, HasTheGravityOfItsWorldUnlessGiven) {
  const std::string still = "Robot r { Base.fixed {} } } Sensor.IMU imu { body = w.r.base; ";
  Running moon("World w { gravity = 1.62; " + still + "}");
  EXPECT_EQ(moon["imu.gravity"], 1.62);
  EXPECT_EQ(moon["imu.accelerometer.z"], 1.62);
  Running tilted("World w { gravity = 0.5, -0.25, -9; " + still + "}");
  EXPECT_EQ(tilted["imu.accelerometer.x"], -0.5);
  EXPECT_EQ(tilted["imu.accelerometer.y"], 0.25);
  EXPECT_EQ(tilted["imu.accelerometer.z"], 9.);
  Running given("World w { gravity = 1.62; " + still + "gravity = 3; horizontal_gravity = 1, 2; }");
  EXPECT_EQ(given["imu.accelerometer.z"], 3.);
  EXPECT_EQ(given["imu.accelerometer.y"], -2.);
}

}  // namespace
}  // namespace hookpoint
