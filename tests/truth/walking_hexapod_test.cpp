// The hexapod of configs/ walks: as fast as it is told to, upright, its weight on the ground and
// its stance feet where they stand.
#include <gtest/gtest.h>
#include <unistd.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <filesystem>
#include <fstream>
#include <map>
#include <numbers>
#include <string>

#include "simulation/dts_engine/dts_engine.h"
#include "simulation/run/world.h"
#include "tests/support/scene.h"

namespace hookpoint::testing {
namespace {

using simulation::BodyState;
using Parameters = std::map<std::string, std::string>;

constexpr double gravity = 9.81;
/// 2 kg and six legs of 0.1 + 0.15 + 0.12 kg.
constexpr double weight = (2. + 6. * 0.37) * gravity;
constexpr double settled = 3.2;  ///< [s] stood, begun, at speed
constexpr double tibia_length = 0.15;

struct Walk {
  bool finished = false;
  Vector3d displacement;             ///< of the base from `settled` to the end [m]
  double duration = 0.;              ///< of that [s]
  double turned = 0.;                ///< yaw over that [rad]
  double lowest = 1., highest = 0.;  ///< of the base [m]
  double height = 0.;                ///< its mean [m]
  double tilt = 0.;                  ///< greatest angle of the base's z from the vertical [rad]
  double slip = 0.;                  ///< way of a foot over the ground in contact, mean of six [m]
  double depth = 0.;                 ///< greatest penetration of a foot [m]
  double load = 0.;                  ///< mean vertical ground force [N]
};

Vector3d tip(const BodyState& tibia) {
  return tibia.position + rotate(tibia.orientation, {tibia_length, 0., 0.});
}

double yaw(const BodyState& base) {
  const Vector3d x = rotate(base.orientation, {1., 0., 0.});
  return std::atan2(x.y, x.x);
}

Walk walk(const std::string& scene, const Parameters& parameters) {
  const simulation::Experiment experiment = load_scene(scene, parameters);
  simulation::World world(experiment, simulation::make_dts(experiment));
  const BodyState& base = world.state().bodies[0];
  const auto steps = std::lround(experiment.duration / experiment.deltat);
  const auto first = std::lround(settled / experiment.deltat);
  Walk result;
  Vector3d begin;
  double heading = 0.;
  std::array<Vector3d, 6> feet{};
  for (long k = 0; k < steps; ++k) {
    if (!world.step().ok()) return result;
    if (k == first) begin = base.position;
    const double turn = std::remainder(yaw(base) - heading, 2. * std::numbers::pi);
    heading = yaw(base);
    std::array<Vector3d, 6> now;
    for (std::size_t leg = 0; leg < 6; ++leg) now[leg] = tip(world.state().bodies[3 * leg + 3]);
    if (k > first) {
      result.turned += turn;
      result.lowest = std::min(result.lowest, base.position.z);
      result.highest = std::max(result.highest, base.position.z);
      result.height += base.position.z;
      result.tilt = std::max(
          result.tilt, std::acos(std::min(1., rotate(base.orientation, Vector3d{0., 0., 1.}).z)));
      for (const BodyState& body : world.state().bodies) result.load += body.contact_force.z;
      for (std::size_t leg = 0; leg < 6; ++leg) {
        result.depth = std::max(result.depth, -now[leg].z);
        if (now[leg].z < 0. && feet[leg].z < 0.)
          result.slip += std::hypot(now[leg].x - feet[leg].x, now[leg].y - feet[leg].y) / 6.;
      }
    }
    feet = now;
  }
  result.finished = true;
  result.displacement = base.position - begin;
  result.duration = double(steps - first - 1) * experiment.deltat;
  result.load /= double(steps - first - 1);
  result.height /= double(steps - first - 1);
  return result;
}

class WalkingHexapod : public ::testing::TestWithParam<const char*> {};

TEST_P(WalkingHexapod, WalksAtTheCommandedSpeedForTwentySeconds) {
  const Walk walked = walk(GetParam(), {{"forward", "0.1 m/s"}});
  ASSERT_TRUE(walked.finished);
  const double speed = walked.displacement.x / walked.duration;
  RecordProperty("speed_mm_per_s", int(1e3 * speed));
  EXPECT_NEAR(speed, 0.1, 0.02);
  EXPECT_NEAR(walked.displacement.y, 0., 0.05);
  EXPECT_NEAR(walked.turned, 0., 0.05);
  // Level, and as high as the legs are told, less what joints and ground give way: at three legs 14
  // N a foot, 1.4 mm in the ground and as much in the joints (14 N at 0.087 m turn a femur of 60
  // N.m/rad by 0.02 rad, 1.8 mm at the foot).
  EXPECT_GT(walked.lowest, 0.1 - 2. * (1.4e-3 + 1.8e-3));
  EXPECT_LT(walked.highest, 0.1 + 1e-3);
  EXPECT_LT(walked.tilt, 2. * std::numbers::pi / 180.);
  // What goes up comes down: on average the ground carries the weight.
  EXPECT_NEAR(walked.load, weight, 0.005 * weight);
  // A stance foot stays: its way over the ground is a fifth of the body's at most, and no foot
  // sinks twice as deep as a load of a third of the weight falling on it at once would (2 m g / 3
  // k).
  EXPECT_LT(walked.slip, 0.2 * walked.displacement.x);
  EXPECT_LT(walked.depth, 2. * 2. * weight / 3. / 1e4);
}

TEST_P(WalkingHexapod, WalksBackwardsSidewaysAndTurns) {
  const Walk back = walk(GetParam(), {{"forward", "-0.1 m/s"}});
  ASSERT_TRUE(back.finished);
  EXPECT_NEAR(back.displacement.x / back.duration, -0.1, 0.02);
  const Walk left = walk(GetParam(), {{"forward", "0 m/s"}, {"sideways", "0.1 m/s"}});
  ASSERT_TRUE(left.finished);
  EXPECT_NEAR(left.displacement.y / left.duration, 0.1, 0.02);
  EXPECT_NEAR(left.displacement.x, 0., 0.05);
  const Walk turning = walk(GetParam(), {{"forward", "0 m/s"}, {"turn", "0.4 rad/s"}});
  ASSERT_TRUE(turning.finished);
  EXPECT_NEAR(turning.turned / turning.duration, 0.4, 0.08);
  EXPECT_LT(std::hypot(turning.displacement.x, turning.displacement.y), 0.05);
}

TEST_P(WalkingHexapod, TwiceTheSpeedIsTwiceTheWay) {
  const Walk walked = walk(GetParam(), {{"forward", "0.2 m/s"}});
  ASSERT_TRUE(walked.finished);
  EXPECT_NEAR(walked.displacement.x / walked.duration, 0.2, 0.04);
  EXPECT_LT(walked.tilt, 2. * std::numbers::pi / 180.);
}

TEST(WalkingHexapodPosture, BringsTheBodyToItsHeight) {
  const std::filesystem::path file = std::filesystem::temp_directory_path() /
                                     ("hookpoint_posture_" + std::to_string(getpid()) + ".hook");
  std::ofstream(file)
      << "Include \"scenes/walking_hexapod.hook\";\n"
         "Include \"controllers/posture.hook\" (robot = world.hexapod, gait = world.gait);\n";
  const Walk without = walk("scenes/walking_hexapod.hook", {});
  const Walk with = walk(file.string(), {});
  std::filesystem::remove(file);
  ASSERT_TRUE(without.finished && with.finished);
  // Joints and ground give way by 2 mm; the integral takes that back.
  EXPECT_LT(without.height, 0.099);
  EXPECT_NEAR(with.height, 0.1, 2e-4);
}

INSTANTIATE_TEST_SUITE_P(Gaits, WalkingHexapod,
                         ::testing::Values("scenes/walking_hexapod.hook",
                                           "scenes/walking_hexapod_cruse.hook"),
                         [](const auto& gait) { return gait.index == 0 ? "Tripod" : "Cruse"; });

}  // namespace
}  // namespace hookpoint::testing
