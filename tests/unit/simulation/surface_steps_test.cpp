// Stairs as a height field: treads level and in their places, risers one cell wide.
#include <gtest/gtest.h>

#include <cmath>
#include <limits>
#include <numbers>

#include "contact/terrain/terrain.h"
#include "simulation/scene/terrain/surface.h"

namespace hookpoint::simulation {
namespace {

StepsGround stairs() {
  StepsGround steps;
  steps.height = 0.1;
  steps.run = 0.3;
  steps.count = 4.;
  steps.from = 0.5;
  return steps;
}

contact::Terrain terrain_of(const StepsGround& steps, const Extent& extent) {
  contact::TerrainDescription description;
  description.surface = steps_surface(steps, extent);
  description.spacing = extent.spacing;
  return contact::Terrain(description);
}

// Along the stairs: level to `from`, a ramp of one cell, the tread of the step, and so on; after
// the last step a landing to the edge. The same whichever quarter turn they go along.
TEST(StepsSurface, TreadsAndRisersAreWhereTheyShouldBe) {
  for (const int quarter : {0, 1, 2, 3}) {
    StepsGround steps = stairs();
    steps.azimuth = quarter * std::numbers::pi / 2.;
    const contact::Terrain terrain = terrain_of(steps, {0.02, 6., 6.});
    const double c = std::round(std::cos(steps.azimuth)), s = std::round(std::sin(steps.azimuth));
    const auto at = [&](double along) {
      return terrain.query(c * along - s * 0.123, s * along + c * 0.123, 0.);
    };
    for (const double along : {-2.9, 0., 0.49}) EXPECT_NEAR(at(along).height, 0., 1e-14);
    for (int step = 0; step < 4; ++step) {
      const double foot = 0.5 + 0.3 * step;
      EXPECT_NEAR(at(foot + 0.005).height, 0.1 * (step + 0.25), 1e-12);
      EXPECT_NEAR(at(foot + 0.01).normal.z, 0.02 / std::hypot(0.1, 0.02), 1e-12);
      for (const double on_tread : {0.021, 0.2, 0.299}) {
        EXPECT_NEAR(at(foot + on_tread).height, 0.1 * (step + 1), 1e-12);
        EXPECT_NEAR(at(foot + on_tread).normal.z, 1., 1e-12);
      }
    }
    EXPECT_NEAR(at(2.9).height, 0.4, 1e-14);
  }
}

TEST(StepsSurface, GoDownAndOnToTheEdge) {
  StepsGround steps = stairs();
  steps.height = -0.05;
  steps.count = std::numeric_limits<double>::infinity();
  const contact::Terrain terrain = terrain_of(steps, {0.05, 8., 2.});
  EXPECT_NEAR(terrain.query(0.5 + 0.3 * 11 - 0.01, 0.3, 0.).height, -0.05 * 11, 1e-12);
}

// Off the quarter turns the vertices sample the same ramps: on a tread, away from risers by a
// cell's diagonal, nothing differs.
TEST(StepsSurface, GoAlongAnyAzimuth) {
  StepsGround steps = stairs();
  steps.azimuth = 0.6;
  const contact::Terrain terrain = terrain_of(steps, {0.02, 6., 6.});
  for (int step = 0; step < 4; ++step) {
    for (const double across : {-1., 0.2, 0.9}) {
      const double along = 0.5 + 0.3 * step + 0.15;
      const double x = along * std::cos(0.6) - across * std::sin(0.6);
      const double y = along * std::sin(0.6) + across * std::cos(0.6);
      EXPECT_NEAR(terrain.query(x, y, 0.).height, 0.1 * (step + 1), 1e-12);
    }
  }
}

TEST(StepsSurface, SaysWhatIsWrong) {
  EXPECT_EQ(steps_problem(stairs(), {0.02, 6., 6.}), "");
  EXPECT_EQ(steps_problem(stairs(), {0.3, 6., 6.}),
            "a run of 0.3 m leaves no tread beside a riser one cell, 0.3 m, wide; lengthen the run "
            "or lower the spacing");
  EXPECT_EQ(steps_problem(stairs(), {0.001, 6., 6.}),
            "6 x 6 m at a spacing of 0.001 m makes 6001 x 6001 vertices, more than 16777216 in "
            "all; raise the spacing or lower the size");
}

}  // namespace
}  // namespace hookpoint::simulation
