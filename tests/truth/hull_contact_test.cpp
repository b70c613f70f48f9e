// Convex hulls under touch = shapes: one of a box's corners moves as the box, a pencil stands on slopes up to
// half the angle between its sides, and a beam on two knife edges loads them by the lever rule.
#include <gtest/gtest.h>

#include <cmath>
#include <numbers>
#include <string>

#include "tests/support/run_text.h"

namespace hookpoint {
namespace {

constexpr double g = 9.81, deg = std::numbers::pi / 180.;

std::string world(const std::string& content) {
  return "World w { touch = shapes; deltat = 0.05 ms; Material m { normal_stiffness = 1e5; "
         "normal_damping = 300; tangential_stiffness = 1e5; tangential_damping = 300; "
         "static_friction = 1; kinetic_friction = 1; } " +
         content + " }";
}

std::string number(double value) { return std::to_string(value); }

/// The points of a brick of these half lengths, as a Shape.Hull or an Obstacle.Hull takes them.
std::string brick(double x, double y, double z) {
  std::string points;
  for (const double i : {-x, x})
    for (const double j : {-y, y})
      for (const double k : {-z, z})
        points += (points.empty() ? "" : ", ") + number(i) + ", " + number(j) + ", " + number(k);
  return "points = " + points + ";";
}

/// Thrown with spin at ground, a step or a box, the hull of a box's corners is where the box is.
TEST(HullContact, AHullOfABoxsCornersMovesAsTheBox) {
  for (const char* surroundings :
       {"Terrain.Flat floor { material = m; }",
        "Terrain.Steps stairs { height = 0.05; run = 0.3; from = 0.15; count = 3; spacing = 10 mm; "
        "size = 4, 4; material = m; }",
        "Terrain.Flat floor { material = m; } Obstacle.Box curb { location = 0.3, 0, 0; dimensions "
        "= 0.2, 2, 0.1; material = m; }"}) {
    const auto thrown = [&](const std::string& shape) {
      return Running(world(
          surroundings +
          std::string(" Robot r { Base.mobile { location = 0, 0, 0.16; velocity = 1.5, 0.2, 0; "
                      "angular_velocity = 2, 5, 1; Shape.") +
          shape + " } }"));
    };
    Running box = thrown("Box { dimensions = 0.1, 0.12, 0.08; mass = 2; material = m; }");
    Running hull = thrown("Hull { " + brick(0.05, 0.06, 0.04) + " mass = 2; material = m; }");
    double hardest = 0.;
    for (int i = 0; i < 8; ++i) {
      for (int j = 0; j < 1000; ++j) {
        box.step();
        hull.step();
        hardest = std::max(hardest, box["w.r.contact.force.z"]);
      }
      for (const char* port : {".position.x", ".position.y", ".position.z", ".angular_velocity.x",
                               ".angular_velocity.y", ".angular_velocity.z"})
        ASSERT_NEAR(hull[std::string("w.r") + port], box[std::string("w.r") + port], 1e-6)
            << surroundings << port << " after " << i;
    }
    EXPECT_GT(hardest, 100.);
  }
}

/// The hull of a regular hexagon's prism across a slope. Its weight passes the lower edge of the side on which
/// it lies at 30 degrees.
TEST(HullContact, APencilRollsOnSlopesOverThirtyDegrees) {
  const double radius = 0.05, apothem = radius * std::cos(30. * deg);
  std::string points;
  for (int corner = 0; corner < 6; ++corner)
    for (const double y : {-0.1, 0.1})
      points += (points.empty() ? "" : ", ") + number(radius * std::cos(60. * deg * corner)) +
                ", " + number(y) + ", " + number(radius * std::sin(60. * deg * corner));
  for (const double angle : {25., 29., 31., 35.}) {
    const double s = std::sin(angle * deg), c = std::cos(angle * deg);
    Running run(world(
        "Terrain.Slope hill { angle = " + number(angle) +
        " deg; material = m; } Robot pencil { Base.mobile { location = " + number(apothem * s) +
        ", 0, " + number(apothem * c) + "; orientation = 0, " + number(angle) +
        " deg, 0; Shape.Hull { points = " + points + "; mass = 0.5; material = m; } } }"));
    run.step(20000);
    const double downhill = (run["w.pencil.position.x"] - apothem * s) * c -
                            (run["w.pencil.position.z"] - apothem * c) * s;
    if (angle < 30.)
      EXPECT_LT(downhill, 1e-3) << angle;
    else
      EXPECT_GT(downhill, radius) << angle;
  }
}

/// A beam of 2 kg, its centre of mass off its middle, on the ridges of two prisms 0.4 m apart.
TEST(HullContact, ABeamLoadsKnifeEdgesByTheLeverRule) {
  const auto knife = [](const std::string& name, const std::string& x) {
    return "Obstacle.Hull " + name + " { location = " + x +
           ", 0, 0; points = -0.05, -0.3, 0, 0.05, -0.3, 0, 0, -0.3, 0.1, -0.05, 0.3, 0, 0.05, "
           "0.3, 0, 0, 0.3, 0.1; material = m; } ";
  };
  for (const double offset : {0., 0.05, -0.12}) {
    Running run(
        world(knife("left", "-0.2") + knife("right", "0.2") +
              "Robot beam { Base.mobile { location = 0, 0, 0.12; mass = 2; center_of_mass = " +
              number(offset) + ", 0, 0; inertia = 0.02, 0.06, 0.06, 0, 0, 0; Shape.Hull { " +
              brick(0.3, 0.05, 0.02) + " material = m; } } }"));
    run.step(20000);
    EXPECT_NEAR(run["w.left.contact.normal_load"], 2. * g * (0.2 - offset) / 0.4, 1e-3) << offset;
    EXPECT_NEAR(run["w.right.contact.normal_load"], 2. * g * (0.2 + offset) / 0.4, 1e-3) << offset;
  }
}

}  // namespace
}  // namespace hookpoint
