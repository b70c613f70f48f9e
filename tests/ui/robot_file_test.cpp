// A robot's file by itself: the world in which `run` and `view` show it.
#include <gtest/gtest.h>

#include <string>

#include "tests/support/command.h"

namespace hookpoint {
namespace {

using testing::CommandResult;
using testing::Workplace;

std::string link(const std::string& name, const std::string& mass, const std::string& shapes) {
  return "<link name=\"" + name + "\"><inertial><mass value=\"" + mass +
         "\"/><inertia ixx=\"0.1\" ixy=\"0\" ixz=\"0\" iyy=\"0.1\" iyz=\"0\" izz=\"0.1\"/></inertial>" +
         shapes + "</link>";
}

constexpr const char* box =
    "<collision><geometry><box size=\"0.4 0.3 0.2\"/></geometry></collision>";
constexpr const char* lost_mesh =
    "<collision><geometry><mesh filename=\"lost.stl\"/></geometry></collision>";

/// A body of 6 kg with a hanging arm of 2 kg, which no drive holds.
std::string robot(const std::string& first, const std::string& shapes) {
  return "<robot name=\"probe\">" + first + link("trunk", "6", shapes) +
         "<joint name=\"shoulder\" type=\"revolute\"><parent link=\"trunk\"/><child link=\"arm\"/>"
         "<origin xyz=\"0 0.2 0.3\"/><axis xyz=\"0 1 0\"/><limit lower=\"-2\" upper=\"2\" effort=\"50\" "
         "velocity=\"9\"/></joint>" +
         link("arm", "2", "") + "</robot>";
}

const std::string on_world =
    "<link name=\"world\"/><joint name=\"foot\" type=\"fixed\"><parent link=\"world\"/><child "
    "link=\"trunk\"/></joint>";

CommandResult run(const Workplace& place, const std::string& file) {
  return place.hookpoint("run " + file + " --for '500 ms' --record '**.position.z,**.angle'");
}

TEST(RobotFile, StandsOnAPlaneWithItsJointsHeld) {
  const Workplace place;
  place.file("probe.urdf", robot("", box));
  const CommandResult result = run(place, "probe.urdf");
  ASSERT_EQ(result.status, 0) << result.err;
  EXPECT_NE(result.err.find("Include \"probe.urdf\" (rest_on = ground, hold = 0.03 rad"),
            std::string::npos)
      << result.err;
  const std::string printed = place.read("runs/world/experiment.hook");
  EXPECT_NE(printed.find("Terrain.Flat ground"), std::string::npos);
  // A quarter of its weight with 1 mm.
  EXPECT_NE(printed.find("nominal_stiffness = 19620"), std::string::npos) << printed.substr(0, 900);
  EXPECT_NE(printed.find("stiffness = "), std::string::npos);
  EXPECT_NE(result.out.find("probe.base"), std::string::npos) << result.out;
}

TEST(RobotFile, OnAFixedBaseHasNoGround) {
  const Workplace place;
  place.file("probe.urdf", robot(on_world, box));
  const CommandResult result = run(place, "probe.urdf");
  ASSERT_EQ(result.status, 0) << result.err;
  EXPECT_EQ(result.err.find("rest_on"), std::string::npos) << result.err;
  EXPECT_EQ(place.read("runs/world/experiment.hook").find("Terrain"), std::string::npos);
}

TEST(RobotFile, WithoutShapesTouchesByItsInertia) {
  const Workplace place;
  place.file("probe.urdf", robot("", lost_mesh));
  const CommandResult result = run(place, "probe.urdf");
  ASSERT_EQ(result.status, 0) << result.err;
  EXPECT_NE(result.err.find("shapes = inertia"), std::string::npos) << result.err;
}

TEST(RobotFile, StandsInItsKeyframe) {
  const Workplace place;
  place.file(
      "probe.xml",
      "<mujoco model=\"probe\"><worldbody><body name=\"trunk\" pos=\"0 0 1\"><freejoint/><geom "
      "type=\"box\" size=\"0.2 0.1 0.05\" mass=\"4\"/><body name=\"arm\" pos=\"0 0.2 0\"><joint "
      "name=\"shoulder\" axis=\"0 1 0\"/><geom type=\"capsule\" size=\"0.02 0.1\" "
      "mass=\"1\"/></body></body></worldbody><keyframe><key name=\"home\" qpos=\"0 0 1 1 0 0 0 "
      "0.4\"/></keyframe></mujoco>");
  const CommandResult result = run(place, "probe.xml");
  ASSERT_EQ(result.status, 0) << result.err;
  EXPECT_NE(result.err.find("keyframe = home"), std::string::npos) << result.err;
  EXPECT_NE(place.read("runs/world/experiment.hook").find("angle = 0.4"), std::string::npos);
}

TEST(RobotFile, OfTheLanguageIsTakenAsItIs) {
  const Workplace place;
  const CommandResult result = run(place, testing::config("robots/hound.hook"));
  ASSERT_EQ(result.status, 0) << result.err;
  EXPECT_NE(result.err.find("Include \"hound.hook\";"), std::string::npos) << result.err;
}

/// What is wrong with it is said as of any file, and nothing is left.
TEST(RobotFile, ThatIsWrongIsRefused) {
  const Workplace place;
  place.file("probe.urdf", "<robot name=\"probe\"><link name=\"trunk\"></robot>");
  place.file("empty.hook", "Material m { }");
  for (const char* file : {"probe.urdf", "empty.hook", "nowhere.urdf"}) {
    const CommandResult result = run(place, file);
    EXPECT_EQ(result.status, 2) << file << '\n' << result.err;
    EXPECT_NE(result.err.find("error"), std::string::npos) << file;
  }
  EXPECT_FALSE(std::filesystem::exists(place.folder() / "runs"));
}

}  // namespace
}  // namespace hookpoint
