// hookpoint export: robots, ground and contact as a model of another program.
#include <gtest/gtest.h>

#include <filesystem>
#include <pugixml.hpp>

#include "tests/support/command.h"
#include "tests/support/folders.h"

namespace hookpoint {
namespace {

using testing::CommandResult;
using testing::config;
using testing::Workplace;

const std::string two =
    "World w { Material a { } Terrain.Flat ground { material = a; }\n"
    "Robot one { Base.mobile { location = 0, 0, 0.1; mass = 1; Shape.Sphere { radius = 0.1; } } }\n"
    "Robot two { Base.mobile { location = 1, 0, 0.1; mass = 3; Shape.Sphere { radius = 0.1; } } } }\n";

TEST(ExportCommand, WritesEachFormat) {
  const Workplace work;
  work.file("two.hook", two);
  for (const char* format : {"mjcf", "sdf"}) {
    const CommandResult result = work.hookpoint(std::string("export two.hook --to ") + format);
    EXPECT_EQ(result.status, 0) << result.err;
    pugi::xml_document document;
    EXPECT_TRUE(document.load_string(result.out.c_str())) << result.out;
    for (const char* name : {"\"one", "\"two", "\"ground\""})
      EXPECT_NE(result.out.find(name), std::string::npos) << format << name;
  }
  const CommandResult one = work.hookpoint("export two.hook --to urdf --robot two --out two.urdf");
  EXPECT_EQ(one.status, 0) << one.err;
  EXPECT_EQ(one.out, "");
  EXPECT_NE(one.err.find("left out:"), std::string::npos) << one.err;
  EXPECT_NE(work.read("two.urdf").find("<robot name=\"two\">"), std::string::npos);
  EXPECT_EQ(work.hookpoint("check two.urdf").status, 0);
}

// A robot's file needs no World: it is put into one, as `view` does.
TEST(ExportCommand, TurnsOneFormatIntoAnother) {
  const Workplace work;
  const CommandResult result =
      work.hookpoint("export " + config("robots/quadruped.urdf") + " --to mjcf --out quad.xml");
  EXPECT_EQ(result.status, 0) << result.err;
  EXPECT_EQ(work.hookpoint("check quad.xml").status, 0);
  EXPECT_NE(work.read("quad.xml").find("solref="), std::string::npos);
}

// The file's own springs and dampers, whatever holds it when it is looked at.
TEST(ExportCommand, HoldsNoJointOfARobotsFile) {
  const Workplace work;
  work.file(
      "arm.xml",
      "<mujoco model=\"arm\"><worldbody><body name=\"trunk\" pos=\"0 0 1\"><freejoint/><geom "
      "type=\"box\" size=\"0.2 0.1 0.05\" mass=\"4\"/><body name=\"arm\"><joint name=\"shoulder\" "
      "axis=\"0 1 0\" damping=\"0.125\" stiffness=\"0.5\"/><geom size=\"0.03\" pos=\"0.15 0 0.1\" "
      "mass=\"1\"/></body></body></worldbody><actuator><position joint=\"shoulder\" "
      "kp=\"20\"/></actuator></mujoco>");
  for (const auto& [format, element] :
       {std::pair{"urdf", "dynamics"}, std::pair{"mjcf", "joint"}}) {
    const CommandResult result = work.hookpoint(std::string("export arm.xml --to ") + format);
    EXPECT_EQ(result.status, 0) << result.err;
    EXPECT_EQ(result.err.find("hold ="), std::string::npos) << result.err;
    EXPECT_NE(result.err.find("Controller.PD"), std::string::npos) << result.err;
    pugi::xml_document document;
    ASSERT_TRUE(document.load_string(result.out.c_str())) << result.out;
    const pugi::xml_node joint = document.find_node([&](const pugi::xml_node& node) {
      return std::string(node.name()) == element && node.attribute("damping");
    });
    EXPECT_EQ(joint.attribute("damping").as_double(), 0.125) << result.out;
    if (std::string(format) == "mjcf") {
      EXPECT_EQ(joint.attribute("stiffness").as_double(), 0.5) << result.out;
    }
  }
}

TEST(ExportCommand, WrongInputIsSaidAndEndsWithStatus2) {
  const Workplace work;
  work.file("two.hook", two);
  work.file("empty.hook", "World w { }\n");
  work.file("wrong.hook", "World w { Robot }\n");
  const std::pair<const char*, const char*> cases[]{
      {"two.hook", "--to is required"},
      {"two.hook --to usd", "no format `usd`"},
      {"two.hook --to urdf", "--robot with one of one, two"},
      {"two.hook --to mjcf --robot three", "no robot `three`"},
      {"empty.hook --to mjcf", "no robot to export"},
      {"wrong.hook --to mjcf", "error"},
      {"nosuch.hook --to mjcf", "nosuch.hook"},
      {"two.hook --to mjcf --creep fast", "--creep takes"},
  };
  for (const auto& [arguments, part] : cases) {
    const CommandResult result = work.hookpoint(std::string("export --out out.xml ") + arguments);
    EXPECT_EQ(result.status, 2) << arguments;
    EXPECT_NE(result.err.find(part), std::string::npos) << arguments << ": " << result.err;
    EXPECT_FALSE(std::filesystem::exists(work.folder() / "out.xml")) << arguments;
  }
}

}  // namespace
}  // namespace hookpoint
