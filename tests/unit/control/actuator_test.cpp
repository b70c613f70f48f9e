// Actuators against closed forms: the torque-speed line, the lag's exponential, Hill's hyperbola.
#include <gtest/gtest.h>

#include <cmath>

#include "tests/support/component_bench.h"

namespace hookpoint {
namespace {

using testing::ComponentBench;

TEST(Actuator, DrivesTheTorqueOfItsJoint) {
  for (const char* name :
       {"Actuator.Torque", "Actuator.Lag", "Actuator.DCMotor", "Actuator.Muscle"}) {
    const control::ComponentClass* type = control::Registry::instance().find(name);
    ASSERT_NE(type, nullptr) << name;
    EXPECT_EQ(type->attachment, control::Attachment::joint);
    EXPECT_EQ(type->default_output, "torque");
    int driving = 0;
    const auto component = type->make();
    for (const control::PortDescription& port : component->ports()) {
      if (port.kind == control::PortKind::output && port.attached == "torque") ++driving;
    }
    EXPECT_EQ(driving, 1) << name;
  }
}

TEST(TorqueActuator, ObeysWithinItsLimit) {
  ComponentBench actuator("Actuator.Torque");
  actuator["limit"] = 2.;
  for (const auto& [command, torque] :
       {std::pair{1.5, 1.5}, {3., 2.}, {-1., -1.}, {-7., -2.}, {0., 0.}}) {
    actuator["command"] = command;
    actuator.tick();
    EXPECT_EQ(actuator["torque"], torque);
  }
}

/// A step of the command at t = 0 is followed by 1 - exp(-t/time_constant), whatever the period of
/// the updates.
TEST(LagActuator, FollowsAStepExponentially) {
  for (const double period : {0.001, 0.007, 0.1}) {
    ComponentBench lag("Actuator.Lag", period);
    lag["time_constant"] = 0.02;
    lag["command"] = 3.;
    for (int k = 0; k < 100; ++k) {
      lag.tick();
      EXPECT_NEAR(lag["torque"], 3. * (1. - std::exp(-k * period / 0.02)), 1e-13) << k;
    }
    lag["command"] = 0.;
    lag.tick();
    const double from = lag["torque"];
    for (int k = 1; k < 50; ++k) {
      lag.tick();
      EXPECT_NEAR(lag["torque"], from * std::exp(-k * period / 0.02), 1e-13) << k;
    }
  }
}

TEST(LagActuator, WithoutTimeConstantIsOneUpdateLate) {
  ComponentBench lag("Actuator.Lag");
  lag["time_constant"] = 0.;
  lag["limit"] = 5.;
  lag["command"] = 3.;
  lag.tick();
  EXPECT_EQ(lag["torque"], 0.);
  lag["command"] = 9.;
  lag.tick();
  EXPECT_EQ(lag["torque"], 3.);
  lag.tick();
  EXPECT_EQ(lag["torque"], 5.);
}

/// Stall 0.2 N.m, no load 500 rad/s, gear 50: at the joint 10 N.m and 10 rad/s.
ComponentBench motor() {
  ComponentBench bench("Actuator.DCMotor");
  bench["stall_torque"] = 0.2;
  bench["no_load_speed"] = 500.;
  bench["gear_ratio"] = 50.;
  return bench;
}

double torque_at(ComponentBench& bench, double command, double rate) {
  bench["command"] = command;
  bench["rate_in"] = rate;
  bench.tick();
  return bench["torque"];
}

TEST(DCMotor, TorqueSpeedLine) {
  ComponentBench bench = motor();
  EXPECT_NEAR(torque_at(bench, 1., 0.), 10., 1e-14);
  EXPECT_NEAR(torque_at(bench, 1., 5.), 5., 1e-14);
  EXPECT_NEAR(torque_at(bench, 1., 10.), 0., 1e-14);
  EXPECT_NEAR(torque_at(bench, 0.5, 5.), 0., 1e-14);
  EXPECT_NEAR(torque_at(bench, 0.5, 0.), 5., 1e-14);
  EXPECT_NEAR(torque_at(bench, -1., 0.), -10., 1e-14);
  EXPECT_NEAR(torque_at(bench, -1., -10.), 0., 1e-14);
  EXPECT_NEAR(torque_at(bench, 0., 4.), -4., 1e-14);  // shorted, it brakes
  EXPECT_NEAR(torque_at(bench, 1., -5.), 15., 1e-14);
  EXPECT_EQ(torque_at(bench, 3., 2.), torque_at(bench, 1., 2.));  // no more than the full voltage
}

TEST(DCMotor, CurrentLimitCutsTheLineOff) {
  ComponentBench bench = motor();
  bench["current_limit"] = 0.3;
  EXPECT_NEAR(torque_at(bench, 1., 0.), 3., 1e-14);
  EXPECT_NEAR(torque_at(bench, 1., 7.), 3., 1e-14);
  EXPECT_NEAR(torque_at(bench, 1., 8.), 2., 1e-14);
  EXPECT_NEAR(torque_at(bench, -1., 3.), -3., 1e-14);
  EXPECT_NEAR(bench["current"], -0.3, 1e-15);
}

/// Power at the joint is efficiency times that of the motor when it drives; when it is driven the
/// motor has 2 - 1/efficiency times that of the joint.
TEST(DCMotor, GearLosesPowerBothWays) {
  ComponentBench bench = motor();
  bench["efficiency"] = 0.8;
  EXPECT_NEAR(torque_at(bench, 1., 0.), 8., 1e-14);
  const double driving = torque_at(bench, 1., 4.) * 4.;
  EXPECT_NEAR(driving, 0.8 * (0.2 * bench["current"] * 50. * 4.), 1e-13);
  const double driven = torque_at(bench, 1., 20.) * 20.;
  EXPECT_LT(driven, 0.);
  EXPECT_NEAR((2. - 1. / 0.8) * driven, 0.2 * bench["current"] * 50. * 20., 1e-12);
}

/// Alone on an inertia J it reaches the no-load speed W as W (1 - exp(-t/T)), T = J W/stall torque;
/// each step of h of this integration multiplies what is missing by 1 - h/T.
TEST(DCMotor, RunsUpToItsNoLoadSpeed) {
  const double inertia = 0.5, step = 0.001, time_constant = inertia * 10. / 10.;
  ComponentBench bench = motor();
  double rate = 0.;
  for (int k = 0; k < 20000; ++k) {
    ASSERT_NEAR(rate, 10. * (1. - std::pow(1. - step / time_constant, k)), 1e-11);
    rate += step * torque_at(bench, 1., rate) / inertia;
  }
  EXPECT_NEAR(rate, 10., 1e-11);
}

/// 200 N, fibres of 0.1 m, 8 lengths a second, on an arm of 0.02 m: 5 rad are one length, 40 rad/s
/// the greatest speed.
ComponentBench muscle(double period = 0.01) {
  ComponentBench bench("Actuator.Muscle", period);
  bench["maximum_force"] = 200.;
  bench["optimal_length"] = 0.1;
  bench["maximum_speed"] = 8.;
  bench["moment_arm"] = 0.02;
  bench["optimal_angle"] = 0.3;
  bench["angle_in"] = 0.3;
  return bench;
}

ComponentBench active_muscle() {
  ComponentBench bench = muscle();
  bench["excitation"] = 1.;
  bench.tick(2000);
  return bench;
}

double force_at(ComponentBench& bench, double length, double speed) {
  bench["angle_in"] = 0.3 - 5. * (length - 1.);
  bench["rate_in"] = -40. * speed;
  bench.tick();
  return bench["force"];
}

TEST(Muscle, IsometricForceAtTheOptimumFollowsTheActivation) {
  for (const double period : {0.001, 0.01}) {
    ComponentBench bench = muscle(period);
    bench["excitation"] = 0.6;
    bench.tick();
    EXPECT_EQ(bench["force"], 0.);
    int k = 1;
    for (; k < 30; ++k) {
      bench.tick();
      const double activation = 0.6 * (1. - std::exp(-k * period / 0.015));
      EXPECT_NEAR(bench["activation"], activation, 1e-14);
      EXPECT_NEAR(bench["force"], 200. * activation, 1e-11);
      EXPECT_NEAR(bench["torque"], 0.02 * 200. * activation, 1e-12);
    }
    bench["excitation"] = -1.;  // as if 0
    bench.tick();
    const double from = bench["activation"];
    for (k = 1; k < 30; ++k) {
      bench.tick();
      EXPECT_NEAR(bench["force"], 200. * from * std::exp(-k * period / 0.05), 1e-11);
    }
  }
}

TEST(Muscle, ForceLengthIsABell) {
  ComponentBench bench = active_muscle();
  EXPECT_NEAR(force_at(bench, 1., 0.), 200., 1e-10);
  EXPECT_NEAR(force_at(bench, 1. - std::sqrt(0.45 * std::log(2.)), 0.), 100., 1e-10);
  EXPECT_NEAR(bench["length"], 1. - std::sqrt(0.45 * std::log(2.)), 1e-14);
  EXPECT_NEAR(force_at(bench, 0.5, 0.), 200. * std::exp(-0.25 / 0.45), 1e-10);
}

TEST(Muscle, ForceVelocityIsHillsHyperbola) {
  ComponentBench bench = active_muscle();
  // (F + a)(v + b) = (F0 + a) b with a/F0 = b/v_max = 1/4.
  for (const double shortening : {0., 0.1, 0.25, 0.5, 0.9, 1.}) {
    const double force = force_at(bench, 1., -shortening) / 200.;
    EXPECT_NEAR((force + 0.25) * (shortening + 0.25), 1.25 * 0.25, 1e-12) << shortening;
  }
  EXPECT_NEAR(force_at(bench, 1., -1.5), 0., 1e-12);  // it cannot push
  EXPECT_LT(force_at(bench, 1., 50.), 1.4 * 200.);
  EXPECT_GT(force_at(bench, 1., 50.), 1.39 * 200.);
  const double slope = (force_at(bench, 1., 1e-7) - force_at(bench, 1., 0.)) / (200. * 1e-7);
  EXPECT_NEAR(slope, 5., 1e-4);  // of the hyperbola on the other side
}

TEST(Muscle, PassiveForceGrowsExponentiallyBeyondTheOptimum) {
  ComponentBench bench = muscle();
  EXPECT_EQ(force_at(bench, 0.9, 0.), 0.);
  EXPECT_EQ(force_at(bench, 1., 0.), 0.);
  EXPECT_NEAR(force_at(bench, 1.6, 0.), 200., 1e-9);
  EXPECT_NEAR(force_at(bench, 1.3, 0.), 200. * (std::exp(2.5) - 1.) / (std::exp(5.) - 1.), 1e-9);
}

/// What a pair does to a joint: the sign of the moment arm, and power at the joint = power of the
/// fibres.
TEST(Muscle, AntagonistPullsBack) {
  ComponentBench flexor = active_muscle(), extensor = active_muscle();
  extensor["moment_arm"] = -0.02;
  for (ComponentBench* bench : {&flexor, &extensor}) (*bench)["angle_in"] = 0.3;
  flexor.tick();
  extensor.tick();
  EXPECT_NEAR(flexor["torque"], 4., 1e-12);
  EXPECT_NEAR(extensor["torque"], -4., 1e-12);
  for (ComponentBench* bench : {&flexor, &extensor}) {
    (*bench)["angle_in"] = 0.8;
    (*bench)["rate_in"] = 3.;
    bench->tick();
  }
  // The joint turns towards the flexor: that one shortens by 0.02 x 3 m/s, the other lengthens as
  // fast.
  EXPECT_NEAR(flexor["length"], 0.9, 1e-14);
  EXPECT_NEAR(extensor["length"], 1.1, 1e-14);
  EXPECT_LT(flexor["force"], 200.);
  EXPECT_GT(extensor["force"], 200.);
  EXPECT_NEAR(flexor["torque"] * 3., flexor["force"] * 0.06, 1e-10);
  EXPECT_NEAR(extensor["torque"] * 3., -extensor["force"] * 0.06, 1e-10);
}

}  // namespace
}  // namespace hookpoint
