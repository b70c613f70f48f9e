// rest_on: where a robot lies on its ground, from m g cos(slope) = n k depth.
#include <gtest/gtest.h>

#include <cmath>
#include <numbers>

#include "simulation/experiment/kinematics.h"
#include "tests/support/folders.h"
#include "tests/support/load_text.h"

namespace hookpoint {
namespace {

using namespace simulation;

constexpr double degree = std::numbers::pi / 180.;

Experiment scene(const std::string& file, const language::EvaluateOptions& options = {}) {
  const Loaded loaded =
      load_file(std::filesystem::path(testing::source_folder()) / "configs" / file, options);
  EXPECT_TRUE(loaded.experiment) << loaded.diagnostics;
  return loaded.experiment.value_or(Experiment{});
}

/// Distance of the block's origin from the plane through the world's origin with normal `n`.
double distance(const Experiment& experiment, const Vector3d& n) {
  return dot(experiment.robots.at(0).location, n);
}

TEST(LoadPose, APenaltyLawStartsAtItsStaticPenetration) {
  for (const double azimuth : {0., 45., 200.}) {
    const Experiment experiment =
        scene("scenes/sloped_block.hook",
              {{{"slope", "20 deg"}, {"azimuth", std::to_string(azimuth) + " deg"}}, {}});
    const double s = std::sin(20 * degree);
    const Vector3d n{s * std::cos(azimuth * degree), s * std::sin(azimuth * degree),
                     std::cos(20 * degree)};
    const double depth = 1. * 9.81 * std::cos(20 * degree) / (4 * 20e3);
    EXPECT_NEAR(distance(experiment, n), 0.05 - depth, 1e-15);
    const RobotSpec& block = experiment.robots[0];
    EXPECT_EQ(block.location.x, 0.);
    EXPECT_EQ(block.location.y, 0.);
    EXPECT_NEAR(norm(rotate(block.orientation, Vector3d{0., 0., 1.}) - n), 0., 1e-15);
    // The shortest tilt: the block's x stays as far from downhill as the slope was turned.
    const Vector3d downhill{std::cos(20 * degree) * std::cos(azimuth * degree),
                            std::cos(20 * degree) * std::sin(azimuth * degree), -s};
    EXPECT_NEAR(dot(rotate(block.orientation, Vector3d{1., 0., 0.}), downhill),
                std::cos(azimuth * degree), 1e-15);
  }
}

TEST(LoadPose, HuntCrossleyStartsWhereItsPowerLawBalances) {
  const Experiment experiment =
      scene("scenes/sloped_block.hook", {{{"slope", "0"}}, {{"world.contact", "hunt_crossley"}}});
  const double depth = std::pow(9.81 / 4 / 20e3, 1 / 1.5);
  EXPECT_NEAR(experiment.robots.at(0).location.z, 0.05 - depth, 1e-14);
}

TEST(LoadPose, ImpulseLawsAndPeersStartTouching) {
  for (const language::Override& choice :
       {language::Override{"world.contact", "impulse"},
        language::Override{"world.contact", "impulse_reversal"},
        language::Override{"world.engine", "ode"}, language::Override{"world.engine", "bullet"}}) {
    const Experiment experiment =
        scene("scenes/sloped_block.hook", {{{"slope", "20 deg"}}, {choice}});
    const Vector3d n{std::sin(20 * degree), 0., std::cos(20 * degree)};
    EXPECT_NEAR(distance(experiment, n), 0.05, 1e-15) << choice.value;
  }
}

TEST(LoadPose, AtAndYawPlaceTheRobot) {
  const Loaded loaded = load_text(
      "World w { Terrain.Flat ground { height = 2; }"
      " Robot bot { Base.mobile { rest_on = ground; at = 3,4; yaw = 90 deg; mass = 1; Shape.Sphere "
      "radius = 0.5; } } }");
  ASSERT_TRUE(loaded.experiment) << loaded.diagnostics;
  const RobotSpec& bot = loaded.experiment->robots[0];
  // One pole of the ball carries the weight on the default material.
  const double k = contact::MaterialConstants<double>{}.normal_stiffness;
  EXPECT_NEAR(norm(bot.location - Vector3d{3., 4., 2.5 - 9.81 / k}), 0., 1e-15);
  EXPECT_NEAR(norm(rotate(bot.orientation, Vector3d{1., 0., 0.}) - Vector3d{0., 1., 0.}), 0.,
              1e-15);
}

// configs/terrains/bumps.txt: 9 x 9 vertices, 0.25 m apart, the north row first; heights 0 along x
// = 0 and 1.
TEST(LoadPose, AGridIsReadBesideItsFileAndLainOn) {
  const Loaded loaded = load_text(
      "World w { Include \"terrains/bumps.hook\"; Robot bot { Base.mobile { rest_on = ground; at = "
      "-0.5, 0.01; mass = 1;"
      " inertia = 1,1,1,0,0,0; ContactPoint foot { } } } }");
  ASSERT_TRUE(loaded.experiment) << loaded.diagnostics;
  const TerrainSpec& terrain = *loaded.experiment->terrain;
  const GridSpec& grid = std::get<GridSpec>(terrain.surface);
  EXPECT_EQ(grid.columns, 9);
  EXPECT_EQ(grid.rows, 9);
  EXPECT_EQ(terrain.spacing, 0.25);
  EXPECT_EQ(grid.origin_x, -1.);
  EXPECT_EQ(grid.heights[4 * 9 + 2], -0.02);  // at -0.5,0
  EXPECT_EQ(loaded.experiment->materials.at(terrain.material).name, "rigid_floor");
  EXPECT_EQ(loaded.experiment->materials.at(terrain.patches.at(0).material).name, "clay");
  // The ground rises to the north of that vertex, so the tile's normal leans south.
  EXPECT_NEAR(loaded.experiment->robots[0].location.z, -0.02, 1e-3);
  EXPECT_LT(rotate(loaded.experiment->robots[0].orientation, Vector3d{0., 0., 1.}).y, 0.);
}

TEST(LoadPose, ALeggedRobotStandsOnItsFeet) {
  const Experiment experiment = scene("scenes/standing_hexapod.hook");
  const RobotSpec& hexapod = experiment.robots.at(0);
  ASSERT_EQ(hexapod.chains.size(), 6U);
  // Femur 0.1 m raised by 30 deg, tibia 0.15 m hanging straight down; 7 N press a foot 0.7 mm in.
  const double weight = 9.81 * (2. + 6 * (0.1 + 0.15 + 0.12));
  EXPECT_NEAR(hexapod.location.z, 0.15 - 0.1 * 0.5 - weight / 6 / (7 / 0.7e-3), 1e-12);
  const std::vector<Pose> poses = body_poses(hexapod);
  const Vector3d foot =
      poses.at(3).position + rotate(poses.at(3).orientation, Vector3d{0.15, 0., 0.});
  // leg[0], rear right: hip at -0.12,-0.1, foot 0.05 + 0.1 cos(30 deg) out, swung 30 deg back.
  const double reach = 0.05 + 0.1 * std::cos(30 * degree);
  EXPECT_NEAR(
      norm(foot - Vector3d{-0.12 - reach * 0.5, -0.1 - reach * std::cos(30 * degree), -0.1}), 0.,
      1e-12);
}

}  // namespace
}  // namespace hookpoint
