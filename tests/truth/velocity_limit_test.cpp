// What a drive does at its velocity_limit: it brings its joint to the limit and no further, gives
// there what the load takes, and brakes nothing. Closed forms, under every integrator, under the
// impulse laws, and in every engine alike.
#include <fmt/format.h>
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <string>

#include "integrators/stepper.h"
#include "reference/engines.h"
#include "tests/support/run_text.h"

namespace hookpoint {
namespace {

/// Calls `check(make, settings of the World, a part that the engine may be off by)`.
template <class Check>
void in_every_engine(const Check& check) {
  for (const integrators::StepperDescription& stepper : integrators::stepper_table()) {
    const std::string setting = "integrator = " + std::string(stepper.name) + ";";
    SCOPED_TRACE(setting);
    check(simulation::make_dts, setting, 1e-9);
  }
  {
    SCOPED_TRACE("contact = impulse");
    check(simulation::make_dts, "contact = impulse;", 1e-9);
  }
  for (const auto& peer : reference::peers()) {
    SCOPED_TRACE(peer.name);
    check(peer.make, "", 1e-4);
  }
}

/// `fields` of a link of 0.2 kg m^2 about z, 2 kg, in a world without gravity.
std::string turning(const std::string& settings, const std::string& fields) {
  return "World w { gravity = 0; deltat = 1 ms; " + settings +
         " Robot r { Base.fixed; Chain c { Link l { mass = 2 kg; inertia = .1,.1,.2,0,0,0; " +
         fields + " } } } }";
}

/// A slider of 20 kg that moves upwards.
std::string lift(const std::string& settings, const std::string& fields) {
  return "World w { gravity = 9.81; deltat = 1 ms; " + settings +
         " Robot r { Base.fixed; Chain c { Link l { joint = prismatic; mass = 20 kg; inertia = "
         "1,1,1,0,0,0; " +
         fields + " } } } }";
}

// 2 N m on 0.2 kg m^2: 10 rad/s^2, so that 3 rad/s are reached at 0.3 s.
TEST(VelocityLimit, IsReachedAtLimitTimesInertiaByTorqueAndKept) {
  in_every_engine([](simulation::EngineFactory make, const std::string& settings, double within) {
    for (const double sign : {1., -1.}) {
      Running run(
          turning(settings, fmt::format("torque = {}; velocity_limit = 3 rad/s;", sign * 2.)),
          make);
      run.step(250);
      EXPECT_NEAR(run["r.c.l.rate"], sign * 2.5, 2.5 * within);
      run.step(100);
      const std::vector<double> rates = run.record("r.c.l.rate", 400);
      for (const double rate : rates) ASSERT_NEAR(rate, sign * 3., 3. * within);
      EXPECT_NEAR(run["r.c.l.total_torque"], 0., 2. * within);
    }
  });
}

TEST(VelocityLimit, IsNotExceededOnTheWayToIt) {
  in_every_engine([](simulation::EngineFactory make, const std::string& settings, double within) {
    // 0.0307 s: no multiple of the step.
    Running run(turning(settings, "torque = 20; velocity_limit = 3.07 rad/s;"), make);
    const std::vector<double> rates = run.record("r.c.l.rate", 200);
    EXPECT_LE(*std::ranges::max_element(rates), 3.07 * (1. + within));
    EXPECT_NEAR(rates.back(), 3.07, 3.07 * within);
  });
}

// 300 N would lift 20 kg ever faster: at 0.5 m/s the drive gives their weight.
TEST(VelocityLimit, IsKeptAgainstALoad) {
  in_every_engine([](simulation::EngineFactory make, const std::string& settings, double within) {
    Running run(lift(settings, "torque = 300; velocity_limit = 0.5 m/s;"), make);
    run.step(500);
    EXPECT_NEAR(run["r.c.l.rate"], 0.5, 0.5 * within);
    EXPECT_NEAR(run["r.c.l.total_torque"], 20. * 9.81, 20. * 9.81 * within);
  });
}

// The weight alone takes the slider beyond: the drive has given -10 N until 0.5 m/s, at
// 0.5/(9.81 + 0.5) s, and nothing from there on. Two steps may be in between.
TEST(VelocityLimit, DoesNotBrakeWhatALoadTakesBeyond) {
  in_every_engine([](simulation::EngineFactory make, const std::string& settings, double within) {
    Running run(lift(settings, "torque = -10; velocity_limit = 0.5 m/s;"), make);
    run.step(1000);
    const double reached = 0.5 / (9.81 + 0.5);
    EXPECT_NEAR(run["r.c.l.rate"], -0.5 - 9.81 * (1. - reached), 2. * 1e-3 * 0.5 + 10. * within);
    EXPECT_NEAR(run["r.c.l.total_torque"], 0., 1e-12);
  });
}

TEST(VelocityLimit, LeavesAFasterJointAloneAndLetsItsDriveBrake) {
  in_every_engine([](simulation::EngineFactory make, const std::string& settings, double within) {
    Running thrown(turning(settings, "rate = 5; torque = 2; velocity_limit = 3 rad/s;"), make);
    thrown.step(200);
    EXPECT_NEAR(thrown["r.c.l.rate"], 5., 5. * within);
    Running braked(turning(settings, "rate = 5; torque = -2; velocity_limit = 3 rad/s;"), make);
    braked.step(200);
    EXPECT_NEAR(braked["r.c.l.rate"], 5. - 10. * 0.2, 5. * within);
  });
}

// A joint of 0.3 kg m^2 and 0.2 kg m^2 that float is one of 0.12 kg m^2.
TEST(VelocityLimit, CountsWhatTheBaseGivesWay) {
  in_every_engine([](simulation::EngineFactory make, const std::string& settings, double within) {
    Running run(
        "World w { gravity = 0; deltat = 1 ms; " + settings +
            " Robot r { Base.mobile { mass = 3 kg; inertia = .2,.2,.3,0,0,0; } Chain c { "
            "Link l { mass = 2 kg; inertia = .1,.1,.2,0,0,0; torque = 1.2; velocity_limit = "
            "3 rad/s; } } } }",
        make);
    run.step(250);
    EXPECT_NEAR(run["r.c.l.rate"], 2.5, 2.5 * within);
    run.step(250);
    EXPECT_NEAR(run["r.c.l.rate"], 3., 3. * within);
    EXPECT_NEAR(run["r.base.angular_velocity.z"], -3. * 0.2 / 0.5, 2. * within);
  });
}

// Two links whose drives both meet their limits: each joint is at its limit while its drive gives
// more than nothing and less than all, and never beyond unless it gives nothing. Methods that do not
// end a step at the limit come there within what the drive makes of a step, on 0.11 kg m^2 at least.
TEST(VelocityLimit, OfCoupledJointsHoldsForEach) {
  in_every_engine([](simulation::EngineFactory make, const std::string& settings, double within) {
    Running run(
        "World w { gravity = 0; deltat = 1 ms; " + settings +
            " Robot r { Base.fixed; Chain c { Link l { mass = 1; center_of_mass = .3,0,0; "
            "inertia = .01,.02,.02,0,0,0; torque = 3; velocity_limit = 2; } Link m { "
            "dhlength = .5; mass = 1; center_of_mass = .3,0,0; inertia = .01,.02,.02,0,0,0; "
            "torque = -1; velocity_limit = 3; } } } }",
        make);
    int at_limit = 0;
    for (int k = 0; k < 1000; ++k) {
      run.step();
      const auto check = [&](const std::string& link, double sign, double limit, double drive) {
        const double rate = sign * run[link + ".rate"], gives = sign * run[link + ".total_torque"];
        const double near = within + 1e-3 * drive / 0.11;
        EXPECT_GE(gives, -1e-9);
        EXPECT_LE(gives, drive * (1. + 1e-9));
        if (gives > 1e-6 * drive) {
          EXPECT_LE(rate, limit + near);
        }
        if (gives > 1e-6 * drive && gives < drive * (1. - 1e-6)) {
          EXPECT_NEAR(rate, limit, near);
          ++at_limit;
        }
      };
      check("r.c.l", 1., 2., 3.);
      check("r.c.m", -1., 3., 1.);
    }
    EXPECT_GT(at_limit, 500);
  });
}

// 80 N m on 0.01 kg m^2 would be 4 rad/s a step.
TEST(VelocityLimit, BoundsAServo) {
  in_every_engine([](simulation::EngineFactory make, const std::string& settings, double within) {
    Running run(
        "World w { gravity = 0; deltat = 0.5 ms; " + settings +
            " Robot r { Base.fixed; Chain c { Link l { velocity_limit = 6 rad/s; mass = 1; inertia "
            "= .01,.01,.01,0,0,0; } } } Controller.PD servo { goal = 2; pconstant = 40; dconstant = "
            "0.5; rate = 1 kHz; Wire FROM r.c.l.angle TO current; Wire FROM r.c.l.rate TO rate_in; "
            "Wire FROM output TO r.c.l.torque; } }",
        make);
    const std::vector<double> rates = run.record("r.c.l.rate", 600);
    EXPECT_NEAR(*std::ranges::max_element(rates), 6., 6. * std::max(within, 1e-6));
    run.step(1400);
    EXPECT_NEAR(run["r.c.l.angle"], 2., 1e-3);
  });
}

TEST(VelocityLimit, IsReportedOnceWhereItIsMet) {
  in_every_engine([](simulation::EngineFactory make, const std::string& settings, double) {
    Running run(turning(settings, "torque = 2; velocity_limit = 3 rad/s;"), make);
    const auto& notices = run.world().state().notices;
    run.step(250);
    const std::size_t before = notices.size();
    run.step(100);
    ASSERT_EQ(notices.size(), before + 1);
    EXPECT_NE(notices.back().find("the drive of r.c.l has to move it faster than its "
                                  "velocity_limit, 3 rad/s, and holds back what would"),
              std::string::npos)
        << notices.back();
  });
}

TEST(VelocityLimit, IsGivenInTheJointsOwnUnits) {
  const auto errors = [](const std::string& fields) {
    return load_text(turning("", fields)).diagnostics;
  };
  EXPECT_EQ(errors("velocity_limit = 90 deg/s;"), "");
  EXPECT_EQ(errors("joint = prismatic; velocity_limit = 1 m/s;"), "");
  for (const char* wrong : {"velocity_limit = 1 m/s;", "velocity_limit = 0;",
                            "velocity_limit = -1;", "joint = fixed; velocity_limit = 1;"})
    EXPECT_NE(errors(wrong), "") << wrong;
}

}  // namespace
}  // namespace hookpoint
