// Closed linkages in the language: the kinematics and the energy of a four-bar linkage, forces, springs
// in place of a constraint, and what is refused.
#include <gtest/gtest.h>

#include <cmath>
#include <string>
#include <utility>
#include <vector>

#include "tests/support/four_bar.h"
#include "tests/support/run_text.h"

namespace hookpoint {
namespace {

using test_support::FourBar;

TEST(Loop, AFourBarLinkageMovesAsItsGeometrySays) {
  Running run(FourBar::text("deltat = 1 ms; integrator = rk4;", ""));
  double energy = 0.;
  for (int i = 0; i < 3000; ++i) {
    const double crank = run["w.bar.left.crank.angle"], rate = run["w.bar.left.crank.rate"];
    const FourBar at(crank);
    ASSERT_NEAR(std::remainder(crank + run["w.bar.left.coupler.angle"] - at.coupler, 2. * M_PI), 0.,
                1e-10);
    ASSERT_NEAR(std::remainder(run["w.bar.right.rocker.angle"] - at.rocker, 2. * M_PI), 0., 1e-10);
    ASSERT_NEAR(run["w.bar.right.rocker.rate"], at.rocker_ratio * rate,
                1e-9 * std::abs(rate) + 1e-9);
    const double now = FourBar::energy(crank, rate);
    if (i == 0) energy = now;
    ASSERT_NEAR(now, energy, 1e-7) << i;
    run.step();
  }
  EXPECT_GT(std::abs(run["w.bar.left.crank.angle"]), 1.);
}

TEST(Loop, DoesNotDriftIn100Seconds) {
  Running run(FourBar::text("deltat = 1 ms;", "axis = 0, 0, 1;"));
  double worst = 0.;
  for (int i = 0; i < 1000; ++i) {
    run.step(100);
    worst = std::max(worst, run["w.bar.pin.error"]);
  }
  EXPECT_LT(worst, 1e-9);
}

// Two rods from the base to one pin carry a weight W between them: T = W/(2 cos) along each.
TEST(Loop, ItsForceIsThatOfStatics) {
  const double half = 0.3, length = 0.5, deep = 0.4;
  const std::string light =
      "mass = 1e-6; center_of_mass = 0.25, 0, 0; inertia = 1e-7, 1e-7, 1e-7, "
      "0, 0, 0; }";
  Running run(
      "World w { gravity = 0, -9.81, 0; deltat = 0.1 ms; Robot frame { Base.fixed { } Chain "
      "l { hip_distance = -0.3, 0, 0; Link rod { angle = -53.13010235415598 deg; " +
      light +
      " Link weight { dhlength = 0.5; angle = 0; mass = 2; inertia = 1, 1, 1, 0, 0, "
      "0; } } Chain r { hip_distance = 0.3, 0, 0; Link rod { angle = -126.86989764584402 "
      "deg; " +
      light + " } Loop pin { a = l.weight; b = r.rod; point_b = 0.5, 0, 0; } } }");
  run.step(1);
  const double cosine = deep / length, tension = 2. * 9.81 / (2. * cosine);
  // On the weight, along the right rod.
  EXPECT_NEAR(run["w.frame.pin.force.x"], tension * half / length, 1e-4);
  EXPECT_NEAR(run["w.frame.pin.force.y"], tension * deep / length, 1e-4);
}

// The penalty counterpart: the gap is the force over the stiffness, so it falls with it.
TEST(Loop, ASpringInPlaceOfAConstraintGivesWayByForceOverStiffness) {
  std::vector<double> gaps;
  for (const auto& [stiffness, damping] : {std::pair{"1e5", "200"}, std::pair{"1e6", "2000"}}) {
    Running run(FourBar::text("deltat = 0.02 ms;", std::string("stiffness = ") + stiffness +
                                                       "; damping = " + damping + ";"));
    run.step(20000);
    const double force = std::hypot(run["w.bar.pin.force.x"], run["w.bar.pin.force.y"]);
    gaps.push_back(run["w.bar.pin.error"]);
    EXPECT_NEAR(force / std::stod(stiffness), gaps.back(), 0.2 * gaps.back());
  }
  EXPECT_LT(gaps[1], 0.2 * gaps[0]);
}

// A parallelogram comes flat, where it may go on as one or fold; no other four-bar linkage does.
TEST(Loop, ASingularLinkageIsReportedOnce) {
  const auto notices = [](const std::string& text) {
    Running run(text);
    run.step(2000);
    return run.world().state().notices;
  };
  const auto rod = [](const std::string& name, double length, const std::string& more) {
    return FourBar::rod(name, length, 0.5, more);
  };
  const std::vector<std::string> flat = notices(
      "World w { gravity = 0; deltat = 0.5 ms; Robot bar { Base.fixed { } Chain left {" +
      rod("crank", 0.1, "angle = 60 deg; rate = -2;") +
      rod("coupler", 0.3, "dhlength = 0.1; angle = -60 deg; rate = 2;") +
      " } Chain right { hip_distance = 0.3, 0, 0;" +
      rod("rocker", 0.1, "angle = 60 deg; rate = -2;") +
      " } Loop pin { a = left.coupler; b = right.rocker; point_a = 0.3, 0, 0; point_b = 0.1, 0, 0; } "
      "} }");
  ASSERT_EQ(flat.size(), 1u);
  EXPECT_NE(flat[0].find("bar: its loops are singular"), std::string::npos) << flat[0];
  EXPECT_TRUE(notices(FourBar::text("deltat = 0.5 ms;")).empty());
}

// Out of its plane, a planar linkage is closed by its hinges: of a pin's three conditions two are
// independent, of a hinge's six as well.
TEST(Loop, ConditionsThatFollowFromOthersAreCounted) {
  EXPECT_NE(load_text(FourBar::text("deltat = 1 ms;"))
                .diagnostics.find("put 3 conditions, 2 of them independent"),
            std::string::npos);
  EXPECT_NE(load_text(FourBar::text("deltat = 1 ms;", "axis = 0, 0, 1;"))
                .diagnostics.find("put 6 conditions, 2 of them independent"),
            std::string::npos);
}

TEST(Loop, WhatCannotBeClosedIsRefused) {
  const Loaded loaded = load_text(
      "World w { gravity = 0; deltat = 1 ms; Robot r { Base.fixed { } Chain l { Link a { mass = 1; "
      "inertia = 1, 1, 1, 0, 0, 0; } } Chain k { hip_distance = 5, 0, 0; Link b { mass = 1; inertia "
      "= 1, 1, 1, 0, 0, 0; } } Loop { a = l.a; b = k.b; point_a = 1, 0, 0; point_b = 1, 0, 0; } } }");
  EXPECT_FALSE(loaded.experiment);
  EXPECT_NE(loaded.diagnostics.find("cannot be closed"), std::string::npos) << loaded.diagnostics;
}

}  // namespace
}  // namespace hookpoint
