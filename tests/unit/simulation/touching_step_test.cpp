// The largest stable step of shapes that touch: edges, rims, bodies on bodies, materials of both sides.
#include <fmt/format.h>
#include <gtest/gtest.h>

#include <cmath>

#include "simulation/analysis/stability.h"
#include "tests/support/load_text.h"

namespace hookpoint {
namespace {

constexpr double stiffness = 1e4;  // [N/m]

simulation::StabilityBound bound_of(const std::string& inside, const std::string& ground = "Flat") {
  const auto loaded = load_text(fmt::format(
      "World w {{ gravity = 9.81; deltat = 1 ms; touch = shapes; Material m {{ normal_stiffness = "
      "{}; normal_damping = 0; static_friction = 0; kinetic_friction = 0; }} Material soft {{ normal_stiffness = {}; normal_damping = 0; "
      "static_friction = 0; kinetic_friction = 0; }} Terrain.{} g {{ {} material = m; }} {} }}",
      stiffness, stiffness / 2., ground,
      ground == "Steps" ? "height = 0.1; run = 0.3; from = 1;" : "", inside));
  EXPECT_TRUE(loaded.experiment && loaded.diagnostics.empty()) << inside;
  return simulation::stability_bound(*loaded.experiment);
}

/// Of semi-implicit Euler without damping: h = 2/omega.
double omega_squared(const simulation::StabilityBound& bound) {
  return 4. / (bound.step * bound.step);
}

std::string cylinder(const std::string& place) {
  return fmt::format(
      "Robot can {{ Base.mobile {{ {} Shape.Cylinder {{ radius = 0.1; length = 0.4; "
      "mass = 2; }} }} }}",
      place);
}

TEST(TouchingStep, ACylinderOnItsEndStandsOnThreePoints) {
  // Three points at radius r a third of a turn apart: up and down 3 k/m, tilting (3/2) k r^2 / I.
  const double up = 3. * stiffness / 2.;
  EXPECT_NEAR(omega_squared(bound_of(cylinder("location = 0, 0, 0.1999;"), "Steps")), up,
              1e-6 * up);
}

TEST(TouchingStep, ACylinderOnItsSideStandsOnTwo) {
  const double I = 2. * (3. * 0.1 * 0.1 + 0.4 * 0.4) / 12.;
  const double rocking = 2. * stiffness * 0.2 * 0.2 / I;
  EXPECT_NEAR(omega_squared(bound_of(cylinder("location = 0, 0, 0.0999; orientation = 0, pi/2, 0;"),
                                     "Steps")),
              rocking, 1e-6 * rocking);
}

std::string box(const std::string& name, double edge, const std::string& rest) {
  return fmt::format(
      "Robot {0} {{ Base.planar {{ {2} Shape.Box {{ dimensions = {1}, {1}, {1}; mass = 2; "
      "}} }} }}",
      name, edge, rest);
}

TEST(TouchingStep, AStackIsStifferThanItsBoxes) {
  // A cube on 4 corners: up and down 4 k/m, tilting 4 k (a/2)^2 / (m a^2/6) = 6 k/m.
  const std::string below = box("a", 0.3, "location = 0, 0, 0.1499;");
  const double lone = 4. * stiffness / 2.;
  EXPECT_NEAR(omega_squared(bound_of(below, "Steps")), 1.5 * lone, 1e-6 * lone);
  // With x = (x_a, x_b), up and down, K/k = [4 + 4, -4; -4, 4]: eigenvalues 6 +- sqrt(20).
  const simulation::StabilityBound stack =
      bound_of(below + box("b", 0.1, "location = 0, 0, 0.3497;"));
  EXPECT_GT(omega_squared(stack), (6. + std::sqrt(20.)) / 4. * lone * (1. - 1e-6));
  EXPECT_EQ(stack.robot, "a; b");
}

TEST(TouchingStep, BothMaterialsCount) {
  const std::string hard = box("a", 0.3, "location = 0, 0, 0.1499;");
  const std::string soft = box("a", 0.3, "material = soft; location = 0, 0, 0.1499;");
  // In series: k/2 and k make k/3.
  EXPECT_NEAR(omega_squared(bound_of(soft, "Steps")) / omega_squared(bound_of(hard, "Steps")),
              1. / 3., 1e-6);
}

TEST(TouchingStep, ManyRobotsAreTakenOneByOneAndStaySafe) {
  std::string pile;
  for (int i = 0; i < 150; ++i)
    pile +=
        box(fmt::format("b{}", i), 0.1, fmt::format("location = 0, 0, {};", 0.0499 + 0.0998 * i));
  const simulation::StabilityBound bound = bound_of(pile);
  EXPECT_EQ(bound.not_computed, "");
  EXPECT_LT(bound.step, 2. / std::sqrt(4. * 4. * stiffness / 2.));  // of the infinite chain
}

}  // namespace
}  // namespace hookpoint
