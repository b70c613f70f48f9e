// Files are known by their content first and by their name second, and refused only where nothing
// reads them.
#include "text/formats.h"

#include <gtest/gtest.h>

#include <string>
#include <string_view>

namespace hookpoint::text {
namespace {

using namespace std::string_view_literals;

/// What each maker's files begin with.
struct Sample {
  const char* name;
  std::string_view content;
  const char* format;
};

const Sample robots_and_scenes[] = {
    {"spot.srdf", "<robot name=\"spot\"><group name=\"arm\"/></robot>", "SRDF"},
    {"a.txt", "#usda 1.0\n", "USD"},
    {"a.usdc", "PXR-USDC\0\0"sv, "USD"},
    {"a.usdz", "PK\x03\x04xyz", "USD"},
    {"a.fbx", "Kaydara FBX Binary  \0"sv, "FBX"},
    {"a.fbx", "; FBX 7.3.0 project file", "FBX"},
    {"a.glb", "glTF\x02\0\0\0"sv, "glTF"},
    {"a.gltf", "{\"asset\": {\"version\": \"2.0\"}}", "glTF"},
    {"robot", "ISO-10303-21;\nHEADER;", "STEP"},
    {"a.ttt", "VREP\x12\0"sv, "CoppeliaSim"},
    {"a.wbt", "#VRML_SIM R2023b utf8", "Webots"},
    {"walker", "{\n  \"joints\": 3}", "JSON"},
    {"walker.json", "[1, 2]", "JSON"},
    {"walker.yaml", "model: x\n", "YAML"},
    {"walker.xml", "<model/>", "XML"},
    {"walker.hook.gz", "\x1f\x8b\x08\0"sv, "packed archive"},
    {"arm.stl", "version https://git-lfs.github.com/spec/v1\noid", "Git LFS"},
    {"go2.urdf", "<!DOCTYPE html>\n<html>", "web page"},
    {"leg.stl", "\0\0\0\0\0"sv, "STL"},
    {"photo", "\xff\xd8\xff\xe0"sv, "JPEG"},
};

TEST(Formats, OfOtherProgramsAreNamedAsExperiments) {
  for (const Sample& sample : robots_and_scenes) {
    const std::string text = refusal(sample.content, sample.name, Use::experiment);
    EXPECT_NE(text.find(sample.format), std::string::npos) << sample.name << ": " << text;
    EXPECT_EQ(text.rfind("this is ", 0), 0U) << text;
    EXPECT_NE(text.back(), '.') << text;
  }
}

TEST(Formats, WhatIsReadIsNotRefused) {
  const std::string_view hook = "World w { }\n";
  for (const char* name : {"a.hook", "a.world", "a.xml", "a.urdf", "a", "a.sdf", "a.json"})
    EXPECT_EQ(refusal(hook, name, Use::experiment), "") << name;
  EXPECT_EQ(refusal("", "empty.world", Use::experiment), "");
  EXPECT_EQ(refusal("<robot name='a'/>", "a.xml", Use::experiment), "");
  EXPECT_EQ(refusal("\xef\xbb\xbf\n<sdf version=\"1.9\">", "yard.world", Use::experiment), "");
  EXPECT_EQ(refusal("<!DOCTYPE m [<!ENTITY a 'b'>]>\n<mujoco/>", "a.xml", Use::experiment), "");
  EXPECT_EQ(refusal("solid a\n", "a.stl", Use::mesh), "");
  EXPECT_EQ(refusal("\0\0\0\1"sv, "A.STL", Use::mesh), "");
  EXPECT_EQ(refusal("v 0 0 0\n", "a.obj", Use::mesh), "");
  EXPECT_EQ(refusal("<COLLADA/>", "a.dae", Use::mesh), "");
  EXPECT_EQ(refusal("\x89PNG\r\n\x1a\n"sv, "a.png", Use::heights), "");
  EXPECT_EQ(refusal("1 2\n3 4\n", "a.txt", Use::heights), "");
  EXPECT_EQ(refusal("ncols 2\n", "a.asc", Use::heights), "");
  EXPECT_EQ(refusal("t,x\n0,1\n", "a.csv", Use::series), "");
  EXPECT_EQ(refusal("t,x\n0,1\n", "a.dat", Use::series), "");
  EXPECT_EQ(refusal("solid fraction [1],x\n0,1\n", "a.csv", Use::series), "");
  EXPECT_EQ(refusal("MATLAB 5.0 MAT-file, Platform: GLNXA64\0\1"sv, "a.mat", Use::series), "");
  EXPECT_EQ(refusal("MATLAB 7.3 MAT-file, Platform: GLNXA64\0\1"sv, "a.mat", Use::series), "");
}

TEST(Formats, TheRefusalSaysWhatIsReadThere) {
  const auto says = [](std::string_view content, const char* name, Use use, const char* words) {
    const std::string text = refusal(content, name, use);
    EXPECT_NE(text.find(words), std::string::npos) << text;
  };
  says("<skel/>", "a.xml", Use::experiment, "URDF");
  says("ply\nformat ascii 1.0", "a.ply", Use::mesh, "STL, OBJ and DAE");
  says("II*\0\0"sv, "dem.tif", Use::heights, "PNG");
  says("{\"t\": [0, 1]}", "a.json", Use::series, "CSV");
  says("\x89HDF\r\n\x1a\n"sv, "movie.h5", Use::experiment, "hookpoint replay");
  says("t,x\n0,1\n", "a.csv", Use::experiment, "Trace");
}

TEST(Formats, TheUsualEndingFindsAReader) {
  EXPECT_EQ(usual_ending("<robot name=\"a\"/>", "a.xml"), ".urdf");
  EXPECT_EQ(usual_ending("<mujoco/>", "a.xml"), ".mjcf");
  EXPECT_EQ(usual_ending("World w { }", "a.hook"), "");
  EXPECT_EQ(usual_ending("", ""), "");
}

/// No content makes it read beyond its end or never return.
TEST(Formats, AnyBeginningEnds) {
  for (const std::string_view whole :
       {"<!-- <mujoco/> -->"sv, "<?xml"sv, "<!DOCTYPE robot [ <!ENTITY a 'b'> ]><robot/>"sv,
        "[{\"a\":"sv, "<"sv, "</"sv, "{ "sv, "\xef\xbb\xbf"sv}) {
    for (std::size_t length = 0; length <= whole.size(); ++length)
      refusal(whole.substr(0, length), "a.xml", Use::experiment);
  }
}

}  // namespace
}  // namespace hookpoint::text
