// The same two gaits and joint controllers walk over rough ground, up a slope, with other legs, as
// an insect and on late, sampled and noisy signals; and fall where the joint loop is unstable. At a
// reduced length: configs/studies/walking.hook has the whole ways.
#include <gtest/gtest.h>

#include <map>
#include <string>

#include "tests/support/walk.h"

namespace hookpoint::testing {
namespace {

using Parameters = std::map<std::string, std::string>;

constexpr double settle = 3.;  ///< [s] stood, begun, at speed
constexpr double command = 0.1;

Walk short_walk(const std::string& scene, const Parameters& parameters) {
  return walk(scene, parameters, settle, 6.);
}

/// A scene, what it is given, how far the speed may be from the command, how much of the way feet
/// may slip.
struct Case {
  const char* name;
  const char* scene;
  Parameters parameters;
  double speed_tolerance, slip;
};

void PrintTo(const Case& walked, std::ostream* out) { *out << walked.name; }

class WalkingGrounds : public ::testing::TestWithParam<std::tuple<Case, int>> {};

TEST_P(WalkingGrounds, WalksAsFastAsToldWithoutFalling) {
  const auto& [walked, cruse] = GetParam();
  Parameters parameters = walked.parameters;
  parameters["cruse"] = std::to_string(cruse);
  const Walk result = short_walk(walked.scene, parameters);
  ASSERT_TRUE(result.finished);
  EXPECT_FALSE(result.fell);
  EXPECT_NEAR(result.speed, command, walked.speed_tolerance * command);
  EXPECT_LT(result.slip, walked.slip);
  EXPECT_GE(result.slip, 0.);
  // A third of the weight that falls at once on a foot of 10 kN/m sinks by 2 m g / 3 k = 2.8 mm; a
  // step from a hump brings more.
  EXPECT_GT(result.depth, 0.);
  EXPECT_LT(result.depth, 6e-3);
}

INSTANTIATE_TEST_SUITE_P(
    Grounds, WalkingGrounds,
    ::testing::Combine(::testing::Values(Case{"Rough", "walking_rough.hook", {}, 0.15, 0.2},
                                         Case{"Slope", "walking_slope.hook", {}, 0.2, 0.2},
                                         Case{
                                             "OtherLegs", "walking_other_legs.hook", {}, 0.15, 0.2},
                                         Case{"Insect", "walking_insect.hook", {}, 0.15, 0.2},
                                         Case{"Late", "walking_late.hook", {}, 0.2, 0.25}),
                       ::testing::Values(0, 1)),
    [](const auto& instance) {
      return std::get<0>(instance.param).name +
             std::string(std::get<1>(instance.param) == 0 ? "Tripod" : "Cruse");
    });

TEST(WalkingSlope, TheBodyFollowsTheSlopeNotTheLevel) {
  // Parallel to the ground within what the level walk tilts (docs/gaits.md), not to gravity.
  EXPECT_LT(short_walk("walking_slope.hook", {}).tilt, 0.02);
}

TEST(WalkingLate, FallsWhereALegsLoopIsUnstableAndNotWhereGoalsAloneAreLate) {
  // K = 20 1/s bears pi/2/K = 78 ms.
  EXPECT_TRUE(short_walk("walking_late.hook", {{"delay", "100 ms"}, {"rate", "1000 Hz"}}).fell);
  const Walk local = short_walk("walking_late.hook", {{"delay", "100 ms"}, {"local_joints", "1"}});
  ASSERT_TRUE(local.finished);
  EXPECT_FALSE(local.fell);
  EXPECT_NEAR(local.speed, command, 0.2 * command);
}

}  // namespace
}  // namespace hookpoint::testing
