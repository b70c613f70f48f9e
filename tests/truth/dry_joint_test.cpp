// Dry friction of a joint as Coulomb has it, and the stop of a sliding joint: under every
// integrator, and under the impulse laws, which fly by RK4.
#include <gtest/gtest.h>

#include <cmath>
#include <string>
#include <vector>

#include "integrators/stepper.h"
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
