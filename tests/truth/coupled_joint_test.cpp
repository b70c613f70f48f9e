// Coupled joints in the language: a rack and its pinion, two geared pendulums, a train of gears, a
// gripper in a loop, and what is refused.
#include <fmt/format.h>
#include <gtest/gtest.h>

#include <cmath>
#include <string>

#include "tests/support/run_text.h"

namespace hookpoint {
namespace {

constexpr double g = 9.81;

/// A link whose mass is at `length` along its x, so that about its joint it has m l^2 + I.
std::string bob(const std::string& name, double mass, double length, double I,
                const std::string& more) {
  return fmt::format(
      " Link {} {{ {} mass = {}; center_of_mass = {}, 0, 0; inertia = {}, {}, {}, 0, 0, 0; }}",
      name, more, mass, length, I, I, I);
}

std::string world(const std::string& chains, const std::string& more = "") {
  return "World w { gravity = 0, -9.81, 0; deltat = 1 ms; integrator = rk4; " + more +
         " Robot train { Base.fixed { } " + chains + " } }";
}

// A weight m on a rack turns a pinion of inertia I and radius r: its acceleration is
// g m / (m + I / r^2) throughout.
TEST(CoupledJoint, AWeightTurnsADrumAtAConstantAcceleration) {
  const double m = 2., I = 0.03, r = 0.1;
  Running run(world("Chain drum { " +
                    bob("wheel", 1., 0., I,
                        "mimic = rack.weight; mimic_ratio = 10; "
                        "mimic_offset = 0.3;") +
                    "} Chain rack { hip_orientation = pi/2, 0, 0; " +
                    bob("weight", m, 0., 1., "joint = prismatic; angle = 0.05;") + " }"));
  run.step(1000);
  const double acceleration = g * m / (m + I / (r * r));
  // The rack's z is -y of the world.
  EXPECT_NEAR(run["w.train.rack.weight.rate"], acceleration, 1e-11);
  EXPECT_NEAR(run["w.train.rack.weight.angle"], 0.05 + acceleration / 2., 1e-11);
  EXPECT_NEAR(run["w.train.drum.wheel.angle"], 0.3 + 10. * run["w.train.rack.weight.angle"], 1e-13);
  EXPECT_NEAR(run["w.train.drum.wheel.rate"], acceleration / r, 1e-10);
  // The tooth's force: m (g - a) on the rack, against gravity.
  EXPECT_NEAR(run["w.train.rack.weight.total_torque"], -m * (g - acceleration), 1e-10);
}

struct Geared {
  static constexpr double m1 = 0.7, l1 = 0.4, I1 = 0.01, m2 = 0.5, l2 = 0.3, I2 = 0.02;
  static constexpr double ratio = -1.7, offset = 0.4;

  static double energy(double q, double rate) {
    const double J = I1 + m1 * l1 * l1 + ratio * ratio * (I2 + m2 * l2 * l2);
    return 0.5 * J * rate * rate +
           g * (m1 * l1 * std::sin(q) + m2 * l2 * std::sin(ratio * q + offset));
  }
};

TEST(CoupledJoint, TwoGearedPendulumsHaveOneDegreeOfFreedom) {
  using G = Geared;
  Running run(world("Chain a { " + bob("first", G::m1, G::l1, G::I1, "angle = 0.2; rate = 1;") +
                    "} Chain b { hip_distance = 1, 0, 0; " +
                    bob("second", G::m2, G::l2, G::I2,
                        "mimic = a.first; mimic_ratio = -1.7; mimic_offset = 0.4;") +
                    "}"));
  const double energy = G::energy(0.2, 1.);
  double farthest = 0.;
  for (int i = 0; i < 3000; ++i) {
    const double q = run["w.train.a.first.angle"], rate = run["w.train.a.first.rate"];
    ASSERT_NEAR(run["w.train.b.second.angle"], G::ratio * q + G::offset, 1e-13);
    ASSERT_NEAR(run["w.train.b.second.rate"], G::ratio * rate, 1e-12);
    ASSERT_NEAR(G::energy(q, rate), energy, 1e-8) << i;
    farthest = std::max(farthest, std::abs(q - 0.2));
    run.step();
  }
  EXPECT_GT(farthest, 0.5);
}

// Three gears in a row, the last one following the second: ratios multiply.
TEST(CoupledJoint, ATrainOfGearsCarriesInertiaByTheSquareOfItsRatio) {
  const double I = 0.01, torque = 0.6;
  Running run(world("Chain a { " + bob("in", 1., 0., I, "torque = 0.6;") + "} Chain b { " +
                    bob("idle", 1., 0., I, "mimic = a.in; mimic_ratio = -2;") + "} Chain c { " +
                    bob("out", 1., 0., I, "mimic = b.idle; mimic_ratio = -3;") + "}"));
  run.step(500);
  const double whole = I * (1. + 4. + 36.);
  EXPECT_NEAR(run["w.train.a.in.rate"], 0.5 * torque / whole, 1e-11);
  EXPECT_NEAR(run["w.train.c.out.rate"], 6. * run["w.train.a.in.rate"], 1e-12);
}

// On a robot that floats, what a gear holds is inside it: momentum stays.
TEST(CoupledJoint, AFloatingRobotKeepsItsMomentum) {
  Running run(
      "World w { gravity = 0; deltat = 1 ms; integrator = rk4; Robot r { Base.mobile { mass = 3; inertia = 0.05, 0.06, "
      "0.07, 0, 0, 0; } Chain a { hip_orientation = 0.3, 0.2, 0; " +
      bob("first", 0.7, 0.2, 0.01, "rate = 3;") + "} Chain b { hip_distance = 0.2, 0.1, 0; " +
      bob("second", 0.5, 0.3, 0.02, "mimic = a.first; mimic_ratio = 0.8;") + "} } }");
  const double vx = run["w.r.center_of_mass_velocity.x"], vz = run["w.r.center_of_mass_velocity.z"];
  const double energy = run["w.r.kinetic_energy"];
  run.step(3000);
  EXPECT_NEAR(run["w.r.center_of_mass_velocity.x"], vx, 1e-9);
  EXPECT_NEAR(run["w.r.center_of_mass_velocity.z"], vz, 1e-9);
  EXPECT_NEAR(run["w.r.kinetic_energy"], energy, 1e-8 * energy);
  EXPECT_GT(std::abs(run["w.r.a.first.angle"]), 1.);
}

void expect_refused(const std::string& chains, const std::string& what,
                    const std::string& more = "") {
  const Loaded loaded = load_text(world(chains, more));
  EXPECT_FALSE(loaded.experiment);
  EXPECT_NE(loaded.diagnostics.find(what), std::string::npos) << loaded.diagnostics;
}

TEST(CoupledJoint, WhatCannotBeCoupledIsRefused) {
  const auto chain = [](const std::string& name, const std::string& more) {
    return "Chain " + name + " { " + bob("j", 1., 0.1, 0.01, more) + "}";
  };
  expect_refused(chain("a", "mimic = b.j;") + chain("b", "mimic = a.j;"), "in a ring");
  expect_refused(chain("a", "mimic = a.j;"), "cannot follow itself");
  expect_refused(chain("a", "mimic_ratio = 2;"), "goes with mimic");
  expect_refused(chain("a", "") + chain("b", "mimic = a.j; angle = 1;"), "leave it out");
  expect_refused(chain("a", "") + chain("b", "mimic = a.j; mimic_offset = 2; upper_limit = 1;"),
                 "above its upper_limit");
  expect_refused(chain("a", "") + chain("b", "mimic = a.j;"), "choose a force law",
                 "contact = impulse; Terrain.Flat f { }");
}

}  // namespace
}  // namespace hookpoint
