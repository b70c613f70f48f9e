// A motor lifts and lowers a weight through a gear with losses: speeds and torques of the steady
// motion by the balance of power in the gear, and what a gear that locks holds, in every engine.
//
// With a weight L on the gear, a stall force S and a no-load speed V at the joint and the voltage u:
// D = S (u - v/V), and L = e D lifted, D = (2 - 1/e) L lowered.
#include <fmt/format.h>
#include <gtest/gtest.h>

#include <cmath>
#include <string>
#include <string_view>

#include "integrators/stepper.h"
#include "reference/engines.h"
#include "tests/support/run_text.h"

namespace hookpoint {
namespace {

constexpr double weight = 0.3 * 9.81, stall = 10., no_load = 1.;

std::string hoist(const std::string& settings, double efficiency, double command,
                  const std::string& link = "") {
  return fmt::format(
      "World w {{ gravity = 9.81; deltat = 1 ms; {} Robot r {{ Base.fixed; Chain c {{ Link l {{ "
      "joint = prismatic; mass = 0.3 kg; inertia = .1,.1,.1,0,0,0; {} }} }} }} Actuator.DCMotor m "
      "{{ joint = r.c.l; stall_torque = 0.2; gear_ratio = 50; no_load_speed = 50; efficiency = {}; "
      "command = {}; }} }}",
      settings, link, efficiency, command);
}

template <class Check>
void in_every_engine(const Check& check) {
  for (const integrators::StepperDescription& stepper : integrators::stepper_table()) {
    SCOPED_TRACE(stepper.name);
    check(simulation::make_dts, "integrator = " + std::string(stepper.name) + ";");
  }
  {
    SCOPED_TRACE("contact = impulse");
    check(simulation::make_dts, "contact = impulse;");
  }
  for (const auto& peer : reference::peers()) {
    SCOPED_TRACE(peer.name);
    check(peer.make, "");
  }
}

void expect_steady(Running& run, double speed) {
  run.step(1000);
  EXPECT_NEAR(run["r.c.l.rate"], speed, 1e-6 * no_load);
  EXPECT_NEAR(run["m.torque"], weight, 1e-5 * weight);
}

TEST(GearEfficiency, LiftsWithWhatIsLeftOfTheMotorsForce) {
  in_every_engine([](simulation::EngineFactory make, const std::string& settings) {
    for (const double e : {1., 0.8, 0.4}) {
      SCOPED_TRACE(e);
      Running run(hoist(settings, e, 1.), make);
      expect_steady(run, no_load * (1. - weight / (e * stall)));
    }
  });
}

TEST(GearEfficiency, LowersAgainstTheMotorByTwoLessItsInverse) {
  in_every_engine([](simulation::EngineFactory make, const std::string& settings) {
    for (const double e : {1., 0.8, 0.6}) {
      for (const double command : {0., -0.2}) {
        SCOPED_TRACE(e);
        Running run(hoist(settings, e, command), make);
        expect_steady(run, no_load * (command - (2. - 1. / e) * weight / stall));
      }
    }
  });
}

// What is put into the motor is lost: the weight's power times 2 - 1/e, and the rest in the gear.
TEST(GearEfficiency, HoldsBetweenBothAtRest) {
  in_every_engine([](simulation::EngineFactory make, const std::string& settings) {
    constexpr double e = 0.8;
    for (const double drive : {(2. - 1. / e) * weight * 1.02, weight, weight / e * 0.98}) {
      Running run(hoist(settings, e, drive / stall), make);
      run.step(2000);
      const double rest = run["r.c.l.angle"];
      EXPECT_LT(std::abs(rest), 2e-3);
      run.step(1000);
      EXPECT_LT(std::abs(run["r.c.l.angle"] - rest), 1e-9);
      EXPECT_NEAR(run["m.torque"], weight, 1e-5 * weight);
    }
  });
}

// The gear's spring deflects by 1 mm under the stall force.
TEST(GearEfficiency, BelowAHalfHoldsAnyLoadWithoutTheMotor) {
  in_every_engine([](simulation::EngineFactory make, const std::string& settings) {
    for (const double e : {0.45, 0.3}) {
      Running run(hoist(settings, e, 0.), make);
      run.step(2000);
      const double rest = run["r.c.l.angle"];
      EXPECT_NEAR(rest, -1e-3 * weight / stall, 1e-6);
      run.step(1000);
      EXPECT_LT(std::abs(run["r.c.l.angle"] - rest), 1e-9);
      EXPECT_NEAR(run["m.torque"], weight, 1e-5 * weight);
      EXPECT_NEAR(run["m.current"], 0., 1e-6);
    }
  });
}

// e = 0.4: m = 1.5, and to lower it the motor has to push with (m - 1) L; less does not move it.
// The rotor carries what the gear does not: engines that have none refuse its inertia by name.
TEST(GearEfficiency, BelowAHalfLowersOnlyWithTheMotor) {
  const auto check = [](simulation::EngineFactory make, const std::string& settings) {
    const std::string rotor = "rotor_inertia = 3 kg;";
    Running down(hoist(settings, 0.4, -1., rotor), make);
    down.step(4000);
    EXPECT_NEAR(down["r.c.l.rate"], -no_load * (1. - 0.5 * weight / stall), 1e-3);
    EXPECT_NEAR(down["m.torque"], weight, 1e-3 * weight);
    Running held(hoist(settings, 0.4, -0.9 * 0.5 * weight / stall, rotor), make);
    held.step(8000);
    EXPECT_NEAR(held["r.c.l.rate"], 0., 1e-9);
    EXPECT_GT(held["r.c.l.angle"], -5e-3);
  };
  for (const integrators::StepperDescription& stepper : integrators::stepper_table()) {
    SCOPED_TRACE(stepper.name);
    check(simulation::make_dts, "integrator = " + std::string(stepper.name) + ";");
  }
  for (const auto& peer : reference::peers()) {
    SCOPED_TRACE(peer.name);
    if (peer.name == "mujoco") {
      check(peer.make, "");
      continue;
    }
    EXPECT_THROW(Running(hoist("", 0.4, -1., "rotor_inertia = 3 kg;"), peer.make),
                 simulation::ExperimentError);
  }
}

}  // namespace
}  // namespace hookpoint
