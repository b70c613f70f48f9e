// The hound of configs/ walks, trots, paces, bounds and gallops over level ground as fast as it is
// told to, and climbs and crosses rubble with one controller in every engine; so does the hexapod.
#include <gtest/gtest.h>

#include <cmath>
#include <map>
#include <numbers>
#include <string>

#include "reference/engines.h"
#include "tests/support/walk.h"

namespace hookpoint::testing {
namespace {

using Parameters = std::map<std::string, std::string>;

/// A gait of the level, its command, and how far the speed may be from it.
struct GaitCase {
  const char* pattern;
  double forward, period, duty_factor, tolerance;
  const char* step_height = "60 mm";
};
void PrintTo(const GaitCase& gait, std::ostream* out) { *out << gait.pattern; }

class WalkingHound : public ::testing::TestWithParam<GaitCase> {};

TEST_P(WalkingHound, GoesAsFastAsTold) {
  const GaitCase& gait = GetParam();
  const Walk result = walk("walking_hound.hook",
                           {{"pattern", gait.pattern},
                            {"forward", std::to_string(gait.forward) + " m/s"},
                            {"period", std::to_string(gait.period) + " s"},
                            {"duty_factor", std::to_string(gait.duty_factor)},
                            {"step_height", gait.step_height}},
                           2., 6.);
  ASSERT_TRUE(result.finished);
  EXPECT_FALSE(result.fell);
  EXPECT_NEAR(result.speed, gait.forward, gait.tolerance * gait.forward);
}

INSTANTIATE_TEST_SUITE_P(Level, WalkingHound,
                         ::testing::Values(GaitCase{"walk", 0.15, 0.8, 0.78, 0.1},
                                           GaitCase{"trot", 0.4, 0.4, 0.55, 0.15},
                                           GaitCase{"pace", 0.4, 0.4, 0.5, 0.15, "80 mm"},
                                           GaitCase{"bound", 0.5, 0.3, 0.45, 0.15},
                                           GaitCase{"gallop", 0.6, 0.3, 0.45, 0.2}),
                         [](const auto& instance) { return std::string(instance.param.pattern); });

TEST(WalkingHound, TurnsAndGoesSideways) {
  const Walk sideways =
      walk("walking_hound.hook", {{"forward", "0 m/s"}, {"sideways", "0.2 m/s"}}, 2., 6.);
  ASSERT_TRUE(sideways.finished);
  EXPECT_FALSE(sideways.fell);
  EXPECT_NEAR(sideways.end.y, 0.2 * 5.5, 0.2 * 0.2 * 5.5);
  const Walk turning = walk("walking_hound.hook", {{"turn", "0.5 rad/s"}}, 2., 6.5);
  ASSERT_TRUE(turning.finished);
  EXPECT_FALSE(turning.fell);
  // 3 rad, less than half a turn from where a heading of more than pi begins again.
  EXPECT_NEAR(std::remainder(turning.heading - 0.5 * 6., 2. * std::numbers::pi), 0.,
              0.15 * 0.5 * 6.);
}

// Soft drives deflect: with its knees forward the hound walks a fifth faster than commanded.
TEST(WalkingHound, WalksWithItsKneesForward) {
  const Walk result = walk(
      "walking_hound.hook",
      {{"knee_forward", "1"}, {"pconstant", "400 N.m/rad"}, {"dconstant", "4 N.m.s/rad"}}, 2., 6.);
  ASSERT_TRUE(result.finished);
  EXPECT_FALSE(result.fell);
  EXPECT_NEAR(result.speed, 0.4, 0.06);
}

/// A scene of steps or rubble, how long it takes, and where the robot is to be by then.
struct Climb {
  const char* scene;
  double duration, least_x, least_z;
  const char* engine;
};
void PrintTo(const Climb& climb, std::ostream* out) { *out << climb.scene << " " << climb.engine; }

class Climbing : public ::testing::TestWithParam<Climb> {};

TEST_P(Climbing, ArrivesInEveryEngineWithOneController) {
  const Climb& climb = GetParam();
  simulation::EngineFactory make = simulation::make_dts;
  for (const reference::Peer& peer : reference::known_peers()) {
    if (peer.name != climb.engine) continue;
    if (!peer.found()) GTEST_SKIP() << climb.engine << " is not installed";
    make = peer.make;
  }
  const Walk result = walk(climb.scene, {}, 1., climb.duration, make);
  ASSERT_TRUE(result.finished);
  EXPECT_FALSE(result.fell);
  EXPECT_GT(result.end.x, climb.least_x);
  EXPECT_LT(std::abs(result.end.y), 0.4);
  EXPECT_GT(result.end.z, climb.least_z);
}

// Of five steps of 0.1 m; the hips 0.28 m over the feet, the hexapod's 0.1 m.
INSTANTIATE_TEST_SUITE_P(Stairs, Climbing,
                         ::testing::Values(Climb{"climbing_hound.hook", 16., 2.1, 0.74, "dts"},
                                           Climb{"climbing_hound.hook", 16., 2.1, 0.74, "bullet"},
                                           Climb{"climbing_hound.hook", 16., 2.1, 0.74, "mujoco"},
                                           Climb{"climbing_hexapod.hook", 26., 1.9, 0.57, "dts"},
                                           Climb{"climbing_hexapod.hook", 26., 1.9, 0.57, "bullet"},
                                           Climb{"climbing_hexapod.hook", 26., 1.9, 0.57,
                                                 "mujoco"}));
INSTANTIATE_TEST_SUITE_P(Rubble, Climbing,
                         ::testing::Values(Climb{"rubble_hound.hook", 15., 2.9, 0.25, "dts"},
                                           Climb{"rubble_hound.hook", 15., 2.9, 0.25, "bullet"},
                                           Climb{"rubble_hound.hook", 15., 2.9, 0.25, "mujoco"},
                                           Climb{"rubble_hexapod.hook", 26., 2.9, 0.08, "dts"},
                                           Climb{"rubble_hexapod.hook", 26., 2.9, 0.08, "bullet"},
                                           Climb{"rubble_hexapod.hook", 26., 2.9, 0.08, "mujoco"}));

}  // namespace
}  // namespace hookpoint::testing
