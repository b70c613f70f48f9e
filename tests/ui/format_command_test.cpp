// Every command that takes a file says which format another program's file is in, and what to do.
#include <gtest/gtest.h>

#include "tests/support/command.h"
#include "tests/support/text.h"

namespace hookpoint {
namespace {

using testing::CommandResult;
using testing::count;
using testing::Workplace;

const std::string skel = "<skel version=\"1.0\">\n  <world/>\n</skel>\n";
const std::string ball =
    "World w { deltat = 1 ms; duration = 1 ms; Terrain.Flat g; Robot b { Base.mobile { rest_on = "
    "g; Shape.Sphere { radius = 0.1; mass = 1; } } } }\n";

/// Refused in one error that names the format, with nothing of a parser that took it for text.
void expect_named(const CommandResult& result, const std::string& format) {
  EXPECT_EQ(result.status, 2) << result.err;
  EXPECT_EQ(count(result.err, "error: "), 1U) << result.err;
  EXPECT_NE(result.err.find("this is " + format), std::string::npos) << result.err;
}

TEST(FormatCommand, FilesOfOtherProgramsAreNamed) {
  const Workplace work;
  work.file("go2.skel", skel);
  for (const char* command : {"run go2.skel", "check go2.skel", "print go2.skel", "fmt go2.skel",
                              "view go2.skel --no-open", "dynamics go2.skel", "ports go2.skel",
                              "study go2.skel", "tune go2.skel", "advise go2.skel", "go2.skel"})
    expect_named(work.hookpoint(command), "a model of DART");
}

TEST(FormatCommand, AnIncludeNamesItWithoutSpeakingOfArguments) {
  const Workplace work;
  work.file("go2.skel", skel);
  work.file("scene.hook", "World w { Include \"go2.skel\" (name = go2, rest_on = g); }\n");
  const CommandResult result = work.hookpoint("check scene.hook");
  expect_named(result, "a model of DART");
  EXPECT_NE(result.err.find("included here"), std::string::npos) << result.err;
}

TEST(FormatCommand, AUrdfIsReadUnderAnyName) {
  const Workplace work;
  work.file("robot.xml",
            "<robot name=\"r\"><link name=\"b\"><inertial><mass value=\"1\"/><inertia ixx=\"1\" "
            "iyy=\"1\" izz=\"1\" ixy=\"0\" ixz=\"0\" iyz=\"0\"/></inertial></link></robot>\n");
  EXPECT_EQ(work.hookpoint("check robot.xml").status, 0) << work.hookpoint("check robot.xml").err;
}

TEST(FormatCommand, ARobotAloneIsSaidToNeedAWorld) {
  const Workplace work;
  for (const char* command : {"ports ", "dynamics ", "advise "}) {
    const CommandResult result = work.hookpoint(command + testing::config("robots/quadruped.urdf"));
    EXPECT_EQ(result.status, 2);
    EXPECT_NE(result.err.find("Include \""), std::string::npos) << result.err;
    EXPECT_EQ(result.err.find("move it into"), std::string::npos) << result.err;
  }
}

TEST(FormatCommand, MeshesGroundsAndSeriesAreNamedToo) {
  const Workplace work;
  work.file("leg.stl", "version https://git-lfs.github.com/spec/v1\n");
  work.file("robot.urdf",
            "<robot name=\"r\"><link name=\"b\"><inertial><mass value=\"1\"/><inertia ixx=\"1\" "
            "iyy=\"1\" izz=\"1\" ixy=\"0\" ixz=\"0\" iyz=\"0\"/></inertial><collision><geometry>"
            "<mesh filename=\"leg.stl\"/></geometry></collision></link></robot>\n");
  work.file("mesh.hook", "World w { Include \"robot.urdf\" (meshes = hull); }\n");
  expect_named(work.hookpoint("run mesh.hook"), "a pointer of Git LFS");
  work.file("dem.tif", std::string("II*\0\0", 5));
  work.file("ground.hook",
            "World w { deltat = 1 ms; duration = 1 ms; Terrain.Grid g { file = \"dem.tif\"; } }\n");
  expect_named(work.hookpoint("run ground.hook"), "a TIFF image");
  work.file("push.json", "{\"t\": [0, 1]}\n");
  work.file("push.hook", ball +
                             "Data push { file = \"push.json\"; column = \"f\"; }\n"
                             "Probe p { Wire FROM push.output; }\n");
  expect_named(work.hookpoint("run push.hook"), "JSON");
}

TEST(FormatCommand, AMissingFileShowsNoEmptyLine) {
  const Workplace work;
  const CommandResult result = work.hookpoint("run nowhere.hook");
  EXPECT_EQ(result.err, "nowhere.hook: error: there is no such file\n");
}

}  // namespace
}  // namespace hookpoint
