// Where a robot starts that `rest_on` puts on the ground: the file's place and heading stay, the ground
// decides height and lean, and a tilt that the file states is reported.
#include <fmt/format.h>
#include <gtest/gtest.h>

#include <cmath>
#include <numbers>
#include <string>

#include "tests/support/command.h"
#include "tests/support/load_text.h"

namespace hookpoint {
namespace {

/// A box of 0.8 x 0.2 x 0.1 m that starts at `pose`, x y z and a quaternion, on the ground.
Loaded load_box(const std::string& pose, const std::string& arguments = "",
                const std::string& ground = "Terrain.Flat ground { }") {
  const testing::Workplace place;
  place.file(
      "box.xml",
      "<mujoco><worldbody><body name=\"b\" pos=\"0 0 1\"><freejoint/><geom type=\"box\" "
      "size=\"0.4 0.1 0.05\" mass=\"3\"/></body></worldbody><keyframe><key name=\"k\" qpos=\"" +
          pose + "\"/></keyframe></mujoco>");
  return load_file(place.file("scene.hook", "World w { " + ground +
                                                " Include \"box.xml\" (name = r, keyframe = k, "
                                                "rest_on = ground" +
                                                arguments + "); }"));
}

TEST(RobotStart, PlaceAndHeadingOfTheFileStayOnTheGround) {
  for (const double yaw : {0.3, -2.5, 3.1}) {
    // Both quaternions of the turn.
    for (const double sign : {1., -1.}) {
      const Loaded loaded = load_box(
          fmt::format("2 -3 0.7 {} 0 0 {}", sign * std::cos(yaw / 2.), sign * std::sin(yaw / 2.)));
      ASSERT_TRUE(loaded.experiment) << loaded.diagnostics;
      EXPECT_EQ(loaded.diagnostics, "");
      const simulation::RobotSpec& robot = loaded.experiment->robots.at(0);
      EXPECT_NEAR(robot.location.x, 2., 1e-9);
      EXPECT_NEAR(robot.location.y, -3., 1e-9);
      EXPECT_NEAR(robot.location.z, 0.05, 1e-3);
      const Vector3d along = rotate(robot.orientation, {1., 0., 0.});
      EXPECT_NEAR(along.x, std::cos(yaw), 1e-9);
      EXPECT_NEAR(along.y, std::sin(yaw), 1e-9);
    }
  }
}

TEST(RobotStart, ArgumentsGoBeforeTheFile) {
  const Loaded loaded = load_box("2 -3 0.7 0.6 0 0 0.8", ", at = 1,1, yaw = 0.5 rad");
  ASSERT_TRUE(loaded.experiment) << loaded.diagnostics;
  const simulation::RobotSpec& robot = loaded.experiment->robots.at(0);
  EXPECT_NEAR(robot.location.x, 1., 1e-9);
  EXPECT_NEAR(rotate(robot.orientation, {1., 0., 0.}).y, std::sin(0.5), 1e-9);
}

// Upside down about x; 0.04 in the quaternion's y: 2 atan(0.04) = 4.58 deg.
TEST(RobotStart, ATiltOfTheFileIsReported) {
  const Loaded over = load_box("0 0 1 0 1 0 0");
  ASSERT_TRUE(over.experiment);
  EXPECT_NEAR(std::abs(over.experiment->robots.at(0).orientation.w), 1., 1e-9);
  EXPECT_NE(over.diagnostics.find("the file has its base tilted by 180 deg, with the orientation "
                                  "0,1,0,0 (w,x,y,z); rest_on starts it level, with 1,0,0,0 on "
                                  "level ground"),
            std::string::npos)
      << over.diagnostics;
  const double length = std::hypot(1., 0.04);
  const Loaded leaning = load_box(fmt::format("0 0 1 {} 0 {} 0", 1. / length, 0.04 / length));
  EXPECT_NE(leaning.diagnostics.find("tilted by 4.58 deg"), std::string::npos)
      << leaning.diagnostics;
}

// A turn by psi and then a lean about a level axis: the heading is psi.
TEST(RobotStart, ATiltedBaseKeepsItsHeading) {
  const double psi = 0.7, lean = 0.2, azimuth = 1.9;
  const Quaterniond turn{std::cos(psi / 2.), 0., 0., std::sin(psi / 2.)};
  const Quaterniond tilt{std::cos(lean / 2.), std::sin(lean / 2.) * std::cos(azimuth),
                         std::sin(lean / 2.) * std::sin(azimuth), 0.};
  const Quaterniond q = tilt * turn;
  const Loaded loaded = load_box(fmt::format("0 0 1 {} {} {} {}", q.w, q.x, q.y, q.z));
  ASSERT_TRUE(loaded.experiment) << loaded.diagnostics;
  const Vector3d along = rotate(loaded.experiment->robots.at(0).orientation, {1., 0., 0.});
  EXPECT_NEAR(std::atan2(along.y, along.x), psi, 1e-9);
  EXPECT_NE(
      loaded.diagnostics.find(fmt::format("tilted by {:.3g} deg", lean * 180. / std::numbers::pi)),
      std::string::npos)
      << loaded.diagnostics;
}

}  // namespace
}  // namespace hookpoint
