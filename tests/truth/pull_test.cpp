// The pull of a person against closed forms: a mass in free fall on it swings, damped, about where
// the spring carries its weight; on every engine; and no pull is no force at all.
#include <gtest/gtest.h>

#include <cmath>

#include "reference/engines.h"
#include "tests/support/run_text.h"

namespace hookpoint {
namespace {

constexpr double m = 2., g = 9.81, k = 300., c = 8., height = 3., target = 2.5;

std::string falling(double dt, const std::string& more = "") {
  return "World w { gravity = 9.81; deltat = " + std::to_string(dt) + "; " + more +
         " Robot b { Base.mobile { location = 0, 0, 3; mass = 2; Shape.Sphere radius = .1; } } }";
}

void set(Running& run, const std::string& trail, double value) {
  const simulation::PortValue one{"Simulator.pull." + trail, value};
  run.world().set(run.world().settable(std::span(&one, 1)).front(), value);
}

/// m u'' = -k u - c u' about u = z - (target - m g / k), from rest.
double closed_form(double t) {
  const double rest = target - m * g / k, decay = c / (2. * m);
  const double omega = std::sqrt(k / m - decay * decay), u = height - rest;
  return rest +
         u * std::exp(-decay * t) * (std::cos(omega * t) + decay / omega * std::sin(omega * t));
}

/// Largest distance from it in one second.
double error_of(double dt, simulation::EngineFactory make, const std::string& more = "") {
  Running run(falling(dt, more), make);
  set(run, "target.z", target);
  set(run, "stiffness", k);
  set(run, "damping", c);
  set(run, "body", 0.);
  const double* z = run.port("b.base.location.z").value;
  double error = 0.;
  for (const auto steps = std::lround(1. / dt); run.world().state().step < steps;) {
    run.step();
    error = std::max(error, std::abs(*z - closed_form(run.world().state().time)));
  }
  return error;
}

TEST(Pull, SwingsAMassAsADampedSpring) {
  for (const char* law : {"contact = hookpoint;", "contact = impulse;"}) {
    const double coarse = error_of(1e-3, simulation::make_dts, law),
                 fine = error_of(2.5e-4, simulation::make_dts, law);
    EXPECT_LT(coarse, 0.01) << law;
    EXPECT_NEAR(fine / coarse, 0.25, 0.03) << law;  // of first order: held over a step
  }
}

TEST(Pull, SwingsItOnEveryEngine) {
  int engines = 0;
  for (const reference::Peer& peer : reference::peers()) {
    if (!peer.found()) continue;
    ++engines;
    EXPECT_LT(error_of(5e-4, peer.make), 0.005) << peer.name;
  }
  EXPECT_GE(engines, 2);
}

// At a point of the rim, on a body that turns: the port is what the state says, and the momentum
// and the moment about the centre are those of that force at that point.
TEST(Pull, ActsAtItsPointAndTellsItsForce) {
  Running run(
      "World w { gravity = 0; deltat = 1 ms; Robot a { Base.mobile { location = 5, 0, 0; mass = 1; "
      "Shape.Sphere radius = .1; } } Robot b { Base.mobile { mass = 2; angular_velocity = 0, 0, 3; "
      "Shape.Sphere radius = .5; } } }");
  for (const auto& [trail, value] : std::initializer_list<std::pair<const char*, double>>{
           {"point.x", .5}, {"target.y", 1.}, {"stiffness", 40.}, {"damping", 2.}, {"body", 1.}})
    set(run, trail, value);
  // p = (.5, 0, 0), v = w x p = (0, 1.5, 0).
  EXPECT_DOUBLE_EQ(run["Simulator.pull.force.x"], 40. * -.5);
  EXPECT_DOUBLE_EQ(run["Simulator.pull.force.y"], 40. * 1. - 2. * 1.5);
  EXPECT_EQ(run["Simulator.pull.force.z"], 0.);
  run.step();
  EXPECT_NEAR(run["b.velocity.x"], 1e-3 * -20. / 2., 1e-12);
  EXPECT_NEAR(run["b.velocity.y"], 1e-3 * 37. / 2., 1e-12);
  const double inertia = 0.4 * 2. * 0.25;
  EXPECT_NEAR(run["b.angular_velocity.z"], 3. + 1e-3 * (.5 * 37.) / inertia, 1e-9);
  EXPECT_EQ(run["a.velocity.x"], 0.);
  // Let go, nothing acts any more.
  set(run, "body", -1.);
  EXPECT_EQ(run["Simulator.pull.force.x"], 0.);
  const double velocity = run["b.velocity.x"];
  run.step(5);
  EXPECT_EQ(run["b.velocity.x"], velocity);
}

TEST(Pull, BeginsWithWhatCarriesTheWeightAndTheStepBears) {
  const Running usual(falling(1e-3));
  EXPECT_DOUBLE_EQ(usual["Simulator.pull.stiffness"], m * g / 0.1);
  EXPECT_DOUBLE_EQ(usual["Simulator.pull.damping"], 1.4 * std::sqrt(m * g / 0.1 * m));
  EXPECT_EQ(usual["Simulator.pull.body"], -1.);
  const Running coarse(falling(0.05));
  EXPECT_DOUBLE_EQ(coarse["Simulator.pull.stiffness"], 0.1 * (m / 4.) / (0.05 * 0.05));
  EXPECT_DOUBLE_EQ(coarse["Simulator.pull.damping"],
                   std::min(0.5 * (m / 4.) / 0.05, 1.4 * std::sqrt(20. * m)));
}

}  // namespace
}  // namespace hookpoint
