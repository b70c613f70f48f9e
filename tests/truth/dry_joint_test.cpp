// Dry friction of a joint as Coulomb has it, and the stop of a sliding joint: under every
// integrator, and under the impulse laws, which fly by RK4.
#include <fmt/format.h>
#include <gtest/gtest.h>

#include <cmath>
#include <string>
#include <vector>

#include "integrators/stepper.h"
#include "reference/engines.h"
#include "tests/support/run_text.h"

namespace hookpoint {
namespace {

/// A slider of 20 kg along x in a world without gravity, or along z in one with.
std::string slider(const std::string& world, const std::string& joint, bool upright = false) {
  const std::string deltat = world.find("deltat") == std::string::npos ? "deltat = 1 ms; " : "";
  return "World w { " + deltat + world + (upright ? " gravity = 9.81; " : " gravity = 0; ") +
         "Robot r { Base.fixed { orientation = " + (upright ? "0,180 deg,0" : "0,90 deg,0") +
         "; } Chain c { Link l { joint = prismatic; mass = 20 kg; inertia = 1,1,1,0,0,0; " + joint +
         " } } } }";
}

std::vector<std::string> integrator_settings() {
  std::vector<std::string> settings;
  for (const integrators::StepperDescription& stepper : integrators::stepper_table())
    settings.push_back("integrator = " + std::string(stepper.name) + ";");
  settings.emplace_back("contact = impulse;");
  return settings;
}

TEST(DryJoint, HoldsALoadBelowItsFriction) {
  for (const std::string& integrator : integrator_settings()) {
    SCOPED_TRACE(integrator);
    Running run(slider(integrator, "friction = 5; torque = 2;"));
    run.step(20000);
    const double rest = run["r.c.l.angle"];
    EXPECT_NEAR(rest, 2. / 5. * 1e-4, 1e-9);  // as far as its spring gives way
    run.step(5000);
    EXPECT_LT(std::abs(run["r.c.l.angle"] - rest) / 5., 1e-12);  // [m/s]
    EXPECT_LT(std::abs(run["r.c.l.rate"]), 1e-12);
  }
}

TEST(DryJoint, SlidesAgainstItsWholeFriction) {
  for (const std::string& integrator : integrator_settings()) {
    SCOPED_TRACE(integrator);
    Running run(slider(integrator, "friction = 5; torque = 8;"));
    run.step(500);
    const double before = run["r.c.l.rate"];
    run.step(1000);
    EXPECT_NEAR(run["r.c.l.rate"] - before, (8. - 5.) / 20., 1e-12);
    EXPECT_EQ(run["r.c.l.total_torque"], 8. - 5.);
  }
}

// v^2/2 = (F/m) x; from there the spring takes it back by its deflection, and half a step's way is
// what a method of first order owes.
TEST(DryJoint, StopsWhereCoulombSaysAndStaysThere) {
  for (const std::string& integrator : integrator_settings()) {
    SCOPED_TRACE(integrator);
    Running run(slider(integrator, "friction = 5; rate = 0.2;"));
    run.step(4000);
    const double way = 0.5 * 20. * 0.2 * 0.2 / 5.;
    EXPECT_NEAR(run["r.c.l.angle"], way, 1e-4 + 0.5 * 0.2 * 1e-3 + 1e-12);
    const double rest = run["r.c.l.angle"];
    run.step(10000);
    EXPECT_NEAR(run["r.c.l.angle"], rest, 1e-9);
    const double later = run["r.c.l.angle"];
    run.step(5000);
    EXPECT_LT(std::abs(run["r.c.l.angle"] - later) / 5., 1e-12);
  }
}

// Coulomb's oscillator, m x'' = -k x - tau_f sign(x'), let go at 0.31 m: each turn lies 2 tau_f/k =
// 0.04 m nearer to the middle than the one before, and at the first within tau_f/k of it, the
// eighth, it stays. At each the friction's spring gives way by z_f = 0.1 mm. Slip reverses within
// the long steps.
TEST(DryJoint, AdaptiveMethodsMeetTheReversalsOfSlip) {
  constexpr double k = 100., friction = 2., start = 0.31, give = 1e-4;
  for (const char* integrator : {"cvode_bdf", "cvode_adams", "arkode", "arkode_imex"}) {
    SCOPED_TRACE(integrator);
    const auto at = [&](const std::string& deltat, int steps) {
      Running run(
          "World w { gravity = 0; deltat = " + deltat +
          "; relative_tolerance = 1e-9; absolute_tolerance = 1e-12; integrator = " + integrator +
          "; Robot r { Base.fixed {} Chain c { Link l { joint = prismatic; mass = 1; "
          "inertia = 1,1,1,0,0,0; friction = 2; stiffness = 100; angle = 0.31; } } } }");
      run.step(steps);
      return run["r.c.l.angle"];
    };
    EXPECT_NEAR(at("100 ms", 10), at("1 ms", 1000), 1e-7);
    double turn = start, sign = 1.;
    int swings = 0;
    for (; turn > friction / k; ++swings, sign = -sign) turn -= 2. * friction / k;
    EXPECT_EQ(swings, 8);
    const double rest = at("200 ms", 40);
    EXPECT_LE(k * std::abs(rest), friction);
    EXPECT_NEAR(rest, sign * turn, swings * give);
  }
}

const std::string sticky = "static_friction = 7.5; friction = 5; ";

// Put on at once, 6 N of 7.5 N swing less than z_f beyond their rest. 7 N drag the hook: with less
// than v_f 7/7.5 = 4.67 mm/s, which 0.5 N stop within 0.44 mm.
TEST(StaticFriction, HoldsALoadAboveTheFrictionOfSlip) {
  for (const std::string& integrator : integrator_settings()) {
    SCOPED_TRACE(integrator);
    for (const double load : {6., 7.}) {
      Running run(slider(integrator, sticky + fmt::format("torque = {};", load)));
      run.step(20000);
      const double rest = run["r.c.l.angle"];
      if (load == 6.) {
        EXPECT_NEAR(rest, load / 7.5 * 1e-4, 1e-9);
      }
      EXPECT_LT(rest, 1e-4 + 0.5 * 20. * 4.67e-3 * 4.67e-3 / 0.5);
      run.step(5000);
      EXPECT_LT(std::abs(run["r.c.l.angle"] - rest) / 5., 1e-12);  // [m/s]
    }
  }
}

TEST(StaticFriction, SlipsAgainstTheFrictionOfSlip) {
  for (const std::string& integrator : integrator_settings()) {
    SCOPED_TRACE(integrator);
    Running run(slider(integrator, sticky + "torque = 8;"));
    run.step(500);
    const double before = run["r.c.l.rate"];
    run.step(1000);
    EXPECT_NEAR(run["r.c.l.rate"] - before, (8. - 5.) / 20., 1e-12);
    EXPECT_NEAR(run["r.c.l.total_torque"], 8. - 5., 1e-14);
  }
}

// As for Coulomb's, but that over its first deflection and the rest of a step, 0.1 mm to 0.3 mm, it
// holds with static_friction: the way is shorter by that times (tau_s - tau_f)/tau_f = 1/2.
TEST(StaticFriction, StopsWhereTheFrictionOfSlipSays) {
  for (const std::string& integrator : integrator_settings()) {
    SCOPED_TRACE(integrator);
    Running run(slider(integrator, sticky + "rate = 0.2;"));
    run.step(4000);
    const double way = 0.5 * 20. * 0.2 * 0.2 / 5.;
    EXPECT_NEAR(run["r.c.l.angle"], way - 1e-4, 2e-4 + 0.5 * 0.2 * 1e-3 + 1e-12);
    const double rest = run["r.c.l.angle"];
    run.step(10000);
    EXPECT_NEAR(run["r.c.l.angle"], rest, 1e-9);
  }
}

/// Pulled by a torque that grows by 1 N m/s from 1.4 N m on, against 1.5 N m of stiction and 1 N m of
/// slip: it starts at 0.1 s, and after t s more its rate is (0.5 t + t^2/2)/J. What the friction's
/// damper, tau_s/v_f, takes while the spring is drawn delays the start by tau_s/v_f times the rate of
/// its deflection, z_f (1 N m/s)/tau_s, and by the way that is then left: some milliseconds.
void expect_start(simulation::EngineFactory make, const std::string& setting, double within) {
  Running run("World w { gravity = 0; deltat = 0.2 ms; " + setting +
                  " Robot r { Base.fixed { } Chain c { Link l { mass = 1 kg; inertia = 0.05, 0.05, "
                  "0.05, 0, 0, 0; static_friction = 1.5; friction = 1; friction_deflection = 0.1 "
                  "mrad; } } } Signal.Ramp pull { initial = 1.4; final = 2.4; duration = 1 s; Wire "
                  "TO r.c.l.torque; } }",
              make);
  run.step(490);
  EXPECT_LT(run["r.c.l.rate"], 1e-3);
  const double* rate = run.port("r.c.l.rate").value;
  int steps = 490;
  while (*rate < 0.1 && steps < 1000) run.step(), ++steps;
  EXPECT_NEAR(steps * 2e-4, 0.1, 0.02);
  run.step(3000 - steps);
  EXPECT_NEAR(*rate, (0.5 * 0.5 + 0.5 * 0.5 * 0.5) / 0.05, within * 7.5);
}

TEST(StaticFriction, StartsWhenThePullExceedsIt) {
  for (const std::string& integrator : integrator_settings()) {
    SCOPED_TRACE(integrator);
    expect_start(simulation::make_dts, integrator, 0.02);
  }
  for (const auto& peer : reference::peers()) {
    SCOPED_TRACE(peer.name);
    expect_start(peer.make, "", 0.02);
  }
}

// At a steady rate w the torque is b w + tau_f + (tau_s - tau_f) exp(-(w/v_s)^2), where b exceeds
// the fall of friction, here at most 0.86 N m s, so that it is stable: 2 N m s 0.5 rad/s + 1 N m +
// 0.5 N m/e at 0.5 rad/s.
TEST(StaticFriction, FallsOverTheStribeckVelocity) {
  const double torque = 2. * 0.5 + 1. + 0.5 * std::exp(-1.);
  const auto rate = [&](const std::string& setting, simulation::EngineFactory make) {
    Running run(
        fmt::format("World w {{ gravity = 0; deltat = 1 ms; {} Robot r {{ Base.fixed {{ }} "
                    "Chain c {{ Link l {{ mass = 1 kg; inertia = 0.05, 0.05, 0.05, 0, 0, 0; "
                    "static_friction = 1.5; friction = 1; stribeck_velocity = 0.5 rad/s; "
                    "damping = 2; torque = {:.17g}; }} }} }} }}",
                    setting, torque),
        make);
    run.step(2000);
    return run["r.c.l.rate"];
  };
  for (const std::string& integrator : integrator_settings())
    EXPECT_NEAR(rate(integrator, simulation::make_dts), 0.5, 1e-6) << integrator;
  for (const auto& peer : reference::peers())
    EXPECT_NEAR(rate("", peer.make), 0.5, 1e-3) << peer.name;
}

TEST(StaticFriction, IsCheckedWhereItStands) {
  const auto errors = [](const std::string& fields) {
    return load_text("World w { Robot r { Base.fixed {} Chain c { Link l { mass = 1; " + fields +
                     " } } } }")
        .diagnostics;
  };
  const auto has = [&](const std::string& fields, const char* text) {
    EXPECT_NE(errors(fields).find(text), std::string::npos) << errors(fields);
  };
  has("friction = 2; static_friction = 1;", "static_friction is below friction");
  has("friction = 2; stribeck_velocity = 1;", "give that too, or leave this out");
  has("static_friction = 1 N;", "static_friction");
  has("kinetic_friction = 1;", "dry friction of its joint is `friction`");
  EXPECT_EQ(errors("joint = prismatic; friction = 1 N; static_friction = 2 N; "
                   "stribeck_velocity = 1 mm/s;"),
            "");
}

TEST(SlidingStop, CarriesAWeightNearItsLimit) {
  for (const std::string& integrator : integrator_settings()) {
    SCOPED_TRACE(integrator);
    Running run(slider(integrator + " deltat = 0.2 ms;", "upper_limit = 0.05;", true));
    run.step(50000);
    EXPECT_NEAR(run["r.c.l.angle"], 0.05 + 20. * 9.81 / 1e5, 1e-8);
  }
}

TEST(SlidingStop, IsAsStiffAsItsLinkSays) {
  Running run(slider("", "upper_limit = 0.05; limit_stiffness = 1e6; limit_damping = 2e3;", true));
  run.step(3000);
  EXPECT_NEAR(run["r.c.l.angle"], 0.05 + 20. * 9.81 / 1e6, 1e-9);
}

}  // namespace
}  // namespace hookpoint
