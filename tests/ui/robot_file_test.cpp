// A robot's file by itself: the world in which `run` and `view` show it.
#include <gtest/gtest.h>

#include <string>

#include "tests/support/command.h"

namespace hookpoint {
namespace {

using testing::CommandResult;
using testing::Workplace;

std::string link(const std::string& name, const std::string& center, const std::string& mass,
                 const std::string& shapes) {
  return "<link name=\"" + name + "\"><inertial><origin xyz=\"" + center + "\"/><mass value=\"" +
         mass +
         "\"/><inertia ixx=\"0.1\" ixy=\"0\" ixz=\"0\" iyy=\"0.1\" iyz=\"0\" izz=\"0.1\"/></inertial>" +
         shapes + "</link>";
}

constexpr const char* box =
    "<collision><geometry><box size=\"0.4 0.3 0.2\"/></geometry></collision>";
constexpr const char* lost_mesh =
    "<collision><geometry><mesh filename=\"lost.stl\"/></geometry></collision>";

/// A body of 6 kg with a level arm of 2 kg, which no drive holds.
std::string robot(const std::string& first, const std::string& shapes) {
  return "<robot name=\"probe\">" + first + link("trunk", "0 0 0", "6", shapes) +
         "<joint name=\"shoulder\" type=\"revolute\"><parent link=\"trunk\"/><child link=\"arm\"/>"
         "<origin xyz=\"0 0.2 0.3\"/><axis xyz=\"0 1 0\"/><limit lower=\"-2\" upper=\"2\" effort=\"50\" "
         "velocity=\"9\"/></joint>" +
         link("arm", "0.1 0 0", "2", "") + "</robot>";
}

const std::string on_world =
    "<link name=\"world\"/><joint name=\"foot\" type=\"fixed\"><parent link=\"world\"/><child "
    "link=\"trunk\"/></joint>";

/// A run of the file, of half a second.
struct Shown {
  int status = -1;
  std::string notes;       ///< on stderr
  std::string experiment;  ///< that the run leaves; empty where there was none
  double angle = 0.;       ///< of the shoulder at the end [rad]
};

Shown show(const Workplace& place, const std::string& file) {
  const CommandResult result =
      place.hookpoint("run " + file + " --for '500 ms' --record '**.angle'");
  Shown shown{result.status, result.err, "", 0.};
  if (result.status != 0) return shown;
  shown.experiment = place.read("runs/world/experiment.hook");
  std::string trace = place.read("runs/world/trace.csv");
  shown.angle = std::stod(trace.substr(trace.rfind(',') + 1));
  return shown;
}

Shown show(const std::string& name, const std::string& text) {
  const Workplace place;
  place.file(name, text);
  return show(place, name);
}

void expect_told(const Shown& shown, const std::string& include) {
  EXPECT_EQ(shown.status, 0) << shown.notes;
  EXPECT_NE(shown.notes.find(include), std::string::npos) << shown.notes;
}

TEST(RobotFile, StandsOnAPlaneWithItsJointsHeld) {
  const Shown shown = show("probe.urdf", robot("", box));
  expect_told(shown, "Include \"probe.urdf\" (rest_on = ground, hold = 0.03 rad");
  EXPECT_NE(shown.experiment.find("Terrain.Flat ground"), std::string::npos);
  // A quarter of its weight with 1 mm.
  EXPECT_NE(shown.experiment.find("nominal_stiffness = 19620"), std::string::npos);
  // Its weight pulls the arm down from the level.
  EXPECT_GT(shown.angle, 1e-4);
  EXPECT_LT(shown.angle, 0.06);
}

TEST(RobotFile, OnAFixedBaseHasNoGround) {
  const Shown shown = show("probe.urdf", robot(on_world, box));
  expect_told(shown, "Include \"probe.urdf\" (hold = 0.03 rad");
  EXPECT_EQ(shown.experiment.find("Terrain"), std::string::npos);
}

TEST(RobotFile, WithoutShapesTouchesByItsInertia) {
  expect_told(show("probe.urdf", robot("", lost_mesh)), "shapes = inertia");
}

TEST(RobotFile, StandsInItsKeyframe) {
  const Shown shown = show(
      "probe.xml",
      "<mujoco model=\"probe\"><worldbody><body name=\"trunk\" pos=\"0 0 1\"><freejoint/><geom "
      "type=\"box\" size=\"0.2 0.1 0.05\" mass=\"4\"/><body name=\"arm\" pos=\"0 0.2 0\"><joint "
      "name=\"shoulder\" axis=\"0 1 0\"/><geom type=\"sphere\" size=\"0.03\" pos=\"0.15 0 0.1\" "
      "mass=\"1\"/></body></body></worldbody><keyframe><key name=\"home\" qpos=\"0 0 1 1 0 0 0 "
      "0.4\"/></keyframe></mujoco>");
  expect_told(shown, "keyframe = home");
  EXPECT_NEAR(shown.angle, 0.4, 0.03);
}

TEST(RobotFile, OfTheLanguageIsTakenAsItIs) {
  expect_told(show(Workplace(), testing::config("robots/hound.hook")), "Include \"hound.hook\";");
}

/// What is wrong with it is said as of any file, and nothing is left.
TEST(RobotFile, ThatIsWrongIsRefused) {
  const Workplace place;
  place.file("probe.urdf", "<robot name=\"probe\"><link name=\"trunk\"></robot>");
  place.file("empty.hook", "Material m { }");
  for (const char* file : {"probe.urdf", "empty.hook", "nowhere.urdf"}) {
    const Shown shown = show(place, file);
    EXPECT_EQ(shown.status, 2) << file << '\n' << shown.notes;
    EXPECT_NE(shown.notes.find("error"), std::string::npos) << file;
  }
  EXPECT_FALSE(std::filesystem::exists(place.folder() / "runs"));
}

}  // namespace
}  // namespace hookpoint
