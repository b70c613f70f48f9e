// Robots and worlds read from SDFormat: frames, joints and masses against arithmetic by hand and against
// libsdformat's own reading of the same text; robots that are written and read again; what is refused,
// in which words and where.
// ctest: alone
#include "simulation/scene/sdf/sdf.h"

#include <gtest/gtest.h>

#include <cmath>
#include <filesystem>
#include <fstream>
#include <map>
#include <numbers>
#include <string>

#include "simulation/experiment/kinematics.h"
#include "simulation/experiment/robot_tree.h"
#include "tests/support/command.h"
#include "tests/support/folders.h"
#include "tests/support/load_text.h"
#include "tests/support/text.h"
#ifdef HOOKPOINT_HAS_SDFORMAT
#include <sdf/sdf.hh>
#endif

namespace hookpoint::tests {
namespace {

using simulation::Pose;

/// Writes the files beside each other and loads a World around an Include of the first.
Loaded load_sdf(const std::map<std::string, std::string>& files,
                const std::string& arguments = "") {
  const testing::Workplace place;
  for (const auto& [name, text] : files) {
    std::filesystem::create_directories((place.folder() / name).parent_path());
    place.file(name, text);
  }
  const std::string list = arguments.empty() ? "" : " (" + arguments + ")";
  return load_file(place.file("scene.hook", "World w { Include \"robot.sdf\"" + list + "; }"));
}

std::string sdf(const std::string& inside, const std::string& version = "1.7") {
  return "<sdf version=\"" + version + "\">\n" + inside + "</sdf>\n";
}
std::string model(const std::string& inside, const std::string& version = "1.7") {
  return sdf("<model name=\"m\">\n" + inside + "</model>\n", version);
}
std::string inertial(double mass, const std::string& pose = "") {
  return "<inertial>" + (pose.empty() ? "" : "<pose>" + pose + "</pose>") + "<mass>" +
         std::to_string(mass) +
         "</mass><inertia><ixx>0.2</ixx><iyy>0.3</iyy><izz>0.4</izz></inertia></inertial>";
}
std::string link(const std::string& name, const std::string& pose = "", double mass = 1.,
                 const std::string& inside = "") {
  return "<link name=\"" + name + "\">" + pose + inertial(mass) + inside + "</link>\n";
}
std::string joint(const std::string& name, const std::string& parent, const std::string& child,
                  const std::string& inside, const std::string& type = "revolute") {
  return "<joint name=\"" + name + "\" type=\"" + type + "\"><parent>" + parent +
         "</parent><child>" + child + "</child>" + inside + "</joint>\n";
}

/// Of each body by its name, in the base's frame.
std::map<std::string, Pose> poses_of(const simulation::RobotSpec& robot) {
  std::map<std::string, Pose> poses;
  const std::vector<Pose> all = simulation::body_poses(robot);
  std::size_t index = 0;
  poses["base"] = all[index++];
  simulation::for_each_link(
      robot, [&](const simulation::TreeLink& at) { poses[at.link.body.name] = all[index++]; });
  return poses;
}

void expect_near(const Vector3d& a, const Vector3d& b) { EXPECT_LE(norm(a - b), 1e-14); }

// A link on a frame on a link; a joint that stands elsewhere in its child, its axis in the model's axes.
TEST(Sdf, FramesStandAsTheyAreWritten) {
  const Loaded loaded = load_sdf(
      {{"robot.sdf",
        model("<pose>1 2 3 0 0 0.5</pose>" + link("base") +
              "<frame name=\"mount\" attached_to=\"base\"><pose>0.1 0 0.2 0 0 0</pose></frame>\n" +
              link("upper", "<pose relative_to=\"mount\">0 0 0.15 0 0.2 0</pose>") +
              joint("shoulder", "base", "upper",
                    "<pose>0 0 -0.15 0 0 0</pose><axis><xyz expressed_in=\"__model__\">0 1 "
                    "0</xyz></axis>"))}});
  ASSERT_TRUE(loaded.experiment) << loaded.diagnostics;
  const simulation::RobotSpec& robot = loaded.experiment->robots.at(0);
  EXPECT_EQ(robot.name, "m");
  EXPECT_TRUE(robot.mobile);
  expect_near(robot.location, {1., 2., 3.});
  const Pose upper = poses_of(robot).at("upper");
  expect_near(upper.position, {0.1 - 0.15 * std::sin(0.2), 0., 0.35 - 0.15 * std::cos(0.2)});
  expect_near(rotate(upper.orientation, {0., 0., 1.}), {0., 1., 0.});  // z is the joint's axis
  // The centre of mass is where the file has it.
  const simulation::BodySpec& body = robot.chains.at(0).links.at(0).body;
  expect_near(upper.position + rotate(upper.orientation, body.mass.center_of_mass),
              {0.1, 0., 0.35});
}

// <pose> in degrees and as a quaternion.
TEST(Sdf, PosesHaveTheNotationsOfSdf) {
  for (const char* pose :
       {"<pose>1 0 0 0 0 1.5707963267948966</pose>", "<pose degrees=\"true\">1 0 0 0 0 90</pose>",
        "<pose rotation_format=\"quat_xyzw\">1 0 0 0 0 1 1</pose>"}) {
    const Loaded loaded = load_sdf(
        {{"robot.sdf", model(link("base") + link("arm", pose) +
                             joint("j", "base", "arm", "<axis><xyz>1 0 0</xyz></axis>"))}});
    ASSERT_TRUE(loaded.experiment) << loaded.diagnostics;
    const Pose arm = poses_of(loaded.experiment->robots.at(0)).at("arm");
    expect_near(rotate(arm.orientation, {0., 0., 1.}), {0., 1., 0.});
  }
}

// The axis is the joint's own, up to 1.4 the model's; `use_parent_model_frame` in between.
TEST(Sdf, AxesAreThoseOfTheVersion) {
  const std::string turned = "<pose>0 0 0 0 0 1.5707963267948966</pose>";
  const auto axis_in = [&](const std::string& version, const std::string& inside) {
    const Loaded loaded = load_sdf(
        {{"robot.sdf",
          model(link("base") + link("arm", turned) +
                    joint("j", "base", "arm", "<axis><xyz>1 0 0</xyz>" + inside + "</axis>"),
                version)}});
    EXPECT_TRUE(loaded.experiment) << loaded.diagnostics;
    if (!loaded.experiment) return Vector3d{};
    return rotate(poses_of(loaded.experiment->robots.at(0)).at("arm").orientation, {0., 0., 1.});
  };
  expect_near(axis_in("1.7", ""), {0., 1., 0.});
  expect_near(axis_in("1.5", ""), {0., 1., 0.});
  expect_near(axis_in("1.4", ""), {1., 0., 0.});
  expect_near(axis_in("1.6", "<use_parent_model_frame>true</use_parent_model_frame>"),
              {1., 0., 0.});
}

TEST(Sdf, JointsHaveWhatTheFileSays) {
  const Loaded loaded = load_sdf(
      {{"robot.sdf",
        model(
            link("base") + link("a") + link("b") + link("c") +
            joint(
                "first", "base", "a",
                "<axis><xyz>0 0 1</xyz><limit><lower>-1</lower><upper>2</upper><effort>30</effort>"
                "<velocity>4</velocity></limit><dynamics><damping>0.1</damping><friction>0.2"
                "</friction><spring_stiffness>5</spring_stiffness><spring_reference>0.3"
                "</spring_reference></dynamics></axis>") +
            joint("second", "a", "b",
                  "<axis><xyz>0 0 1</xyz><limit><lower>-1e16</lower><upper>1e16</upper>"
                  "<effort>-1</effort></limit></axis>",
                  "prismatic") +
            joint("third", "b", "c",
                  "<axis><xyz>0 0 1</xyz><limit><lower>-inf</lower><upper>inf</upper></limit>"
                  "<mimic joint=\"first\"><multiplier>2</multiplier><offset>0.4</offset>"
                  "<reference>0.1</reference></mimic></axis>"))}});
  ASSERT_TRUE(loaded.experiment) << loaded.diagnostics;
  const auto& links = loaded.experiment->robots.at(0).chains.at(0).links;
  EXPECT_EQ(links.at(0).lower_limit, -1.);
  EXPECT_EQ(links.at(0).upper_limit, 2.);
  EXPECT_EQ(links.at(0).effort_limit, 30.);
  EXPECT_EQ(links.at(0).velocity_limit, 4.);
  EXPECT_EQ(links.at(0).damping, 0.1);
  EXPECT_EQ(links.at(0).friction, 0.2);
  EXPECT_EQ(links.at(0).stiffness, 5.);
  EXPECT_EQ(links.at(0).rest_angle, 0.3);
  EXPECT_FALSE(links.at(1).lower_limit || links.at(1).effort_limit);
  EXPECT_FALSE(links.at(2).lower_limit);
  ASSERT_EQ(loaded.experiment->couplings.size(), 1u);
  EXPECT_EQ(loaded.experiment->couplings[0].ratio, 2.);
  EXPECT_NEAR(loaded.experiment->couplings[0].offset, 0.2, 1e-15);
}

// Of a Cardan joint the first axis is fixed in the parent, the second in the child.
TEST(Sdf, AUniversalJointIsTwo) {
  const Loaded loaded = load_sdf(
      {{"robot.sdf", model(link("base") + link("arm", "<pose>0 0 1 0 0 0</pose>") +
                           joint("cardan", "base", "arm",
                                 "<axis><xyz>1 0 0</xyz></axis><axis2><xyz>0 1 0</xyz></axis2>",
                                 "universal"))}});
  ASSERT_TRUE(loaded.experiment) << loaded.diagnostics;
  const simulation::RobotSpec& robot = loaded.experiment->robots.at(0);
  ASSERT_EQ(robot.chains.at(0).links.size(), 2u);
  EXPECT_EQ(robot.chains[0].links[0].body.mass.mass, 0.);
  const auto poses = poses_of(robot);
  expect_near(poses.at("arm").position, {0., 0., 1.});
  expect_near(rotate(poses.at("arm").orientation, {0., 0., 1.}), {0., 1., 0.});
  expect_near(rotate(poses.at("cardan_cross").orientation, {0., 0., 1.}), {1., 0., 0.});
}

// Without <inertial> a link has SDFormat's 1 kg; `auto` computes it of the collisions.
TEST(Sdf, MassesAreThoseOfTheFormat) {
  const Loaded bare = load_sdf({{"robot.sdf", model("<link name=\"a\"/>")}});
  ASSERT_TRUE(bare.experiment) << bare.diagnostics;
  EXPECT_EQ(bare.experiment->robots.at(0).base.mass.mass, 1.);
  EXPECT_EQ(bare.experiment->robots.at(0).base.mass.inertia.xx, 1.);
  EXPECT_TRUE(testing::has(bare.diagnostics, "1 kg")) << bare.diagnostics;
  const Loaded computed = load_sdf(
      {{"robot.sdf",
        model("<link name=\"a\"><inertial auto=\"true\"/><collision name=\"c\"><pose>0 0 1 0 0 0"
              "</pose><density>500</density><geometry><sphere><radius>0.1</radius></sphere>"
              "</geometry></collision></link>",
              "1.11")}});
  ASSERT_TRUE(computed.experiment) << computed.diagnostics;
  const simulation::MassSpec& mass = computed.experiment->robots.at(0).base.mass;
  const double expected = 500. * 4. / 3. * std::numbers::pi * 1e-3;
  EXPECT_NEAR(mass.mass, expected, 1e-14);
  expect_near(mass.center_of_mass, {0., 0., 1.});
  EXPECT_NEAR(mass.inertia.xx, 0.4 * expected * 0.01, 1e-16);
}

const std::string box_collision =
    "<collision name=\"c\"><geometry><box><size>0.2 0.4 0.6</size></box></geometry><surface>"
    "<friction><ode><mu>0.6</mu></ode></friction><contact><ode><kp>20000</kp><kd>50</kd></ode>"
    "</contact></surface></collision>";

TEST(Sdf, ContactIsTheFilesWhereItIsRequested) {
  const std::map<std::string, std::string> file{
      {"robot.sdf", model(link("a", "", 1., box_collision))}};
  const auto material =
      [&](const std::string& arguments) -> std::optional<simulation::MaterialSpec> {
    const Loaded loaded = load_sdf(file, arguments);
    EXPECT_TRUE(loaded.experiment) << loaded.diagnostics;
    const simulation::ShapeSpec& shape = loaded.experiment->robots.at(0).base.shapes.at(0);
    if (shape.material == simulation::no_material) return std::nullopt;
    return loaded.experiment->materials.at(static_cast<std::size_t>(shape.material));
  };
  ASSERT_TRUE(material(""));
  EXPECT_EQ(material("")->constants.static_friction, 0.6);
  EXPECT_EQ(material("contact = file")->constants.normal_stiffness, 20000.);
  EXPECT_EQ(material("contact = file")->constants.normal_damping, 50.);
  EXPECT_FALSE(material("contact = ground"));
}

// A limit on one side alone, with a start beyond it.
TEST(Sdf, ALimitMayBeOnOneSide) {
  for (const auto& [limit, expected] :
       {std::pair{"<lower>0.6</lower>", 0.6}, std::pair{"<upper>-0.6</upper>", -0.6},
        std::pair{"<lower>-1</lower>", 0.}}) {
    const Loaded loaded = load_sdf(
        {{"robot.sdf",
          model(link("a") + link("b") +
                joint("j", "a", "b", "<axis><limit>" + std::string(limit) + "</limit></axis>"))}});
    ASSERT_TRUE(loaded.experiment) << loaded.diagnostics;
    EXPECT_EQ(loaded.experiment->robots.at(0).chains.at(0).links.at(0).angle, expected) << limit;
  }
}

// Words of truth are of any case, frictions that print alike are two, and a sensor's shape touches nothing.
TEST(Sdf, IsReadAsGazeboReadsIt) {
  const auto ball = [](const std::string& surface) {
    return "<collision name=\"c" + std::to_string(surface.size()) +
           "\"><geometry><sphere><radius>0.1</radius></sphere></geometry><surface>" + surface +
           "</surface></collision>";
  };
  const auto mu = [](const std::string& value) {
    return "<friction><ode><mu>" + value + "</mu></ode></friction>";
  };
  const Loaded loaded = load_sdf(
      {{"robot.sdf",
        sdf("<world name=\"w\"><model name=\"wall\"><static>True</static>" +
            link("l", "<pose degrees=\"TRUE\">0 0 0 0 0 90</pose>", 1., box_collision) +
            "</model><model name=\"m\">" +
            link(
                "a", "", 1.,
                ball(mu("1000000")) + ball(mu("0.000001")) + ball(mu("0.60000010")) +
                    ball(mu("0.600000200")) +
                    ball(
                        "<contact><collide_without_contact>true</collide_without_contact></contact>")) +
            "</model></world>")}});
  ASSERT_TRUE(loaded.experiment) << loaded.diagnostics;
  ASSERT_EQ(loaded.experiment->obstacles.size(), 1u);
  expect_near(rotate(loaded.experiment->obstacles[0].orientation, {1., 0., 0.}), {0., 1., 0.});
  const simulation::BodySpec& base = loaded.experiment->robots.at(0).base;
  ASSERT_EQ(base.shapes.size(), 4u);
  EXPECT_EQ(base.shapes_without_contact.size(), 1u);
  const std::vector<double> expected{1e6, 1e-6, 0.6000001, 0.6000002};
  for (std::size_t i = 0; i < 4; ++i)
    EXPECT_EQ(loaded.experiment->materials.at(static_cast<std::size_t>(base.shapes[i].material))
                  .constants.static_friction,
              expected[i]);
}

// The same file twice, and another with the same surface.
TEST(Sdf, SeveralIncludesDoNotClash) {
  const testing::Workplace place;
  const std::string yard =
      sdf("<world name=\"w\"><model name=\"wall\"><static>1</static>" +
          link("l", "", 1., box_collision) + "</model><model name=\"m\"><pose>0 0 1 0 0 0</pose>" +
          link("a", "", 1., box_collision) + "</model></world>");
  place.file("yard.sdf", yard);
  const Loaded loaded = load_file(place.file(
      "scene.hook",
      "World w { Include \"yard.sdf\" (name = left); Include \"yard.sdf\" (name = right); }"));
  ASSERT_TRUE(loaded.experiment) << loaded.diagnostics;
  EXPECT_EQ(loaded.experiment->robots.size(), 2u);
  EXPECT_EQ(loaded.experiment->obstacles.size(), 2u);
}

std::string static_model(const std::string& name, const std::string& pose,
                         const std::string& geometry) {
  return "<model name=\"" + name + "\"><static>true</static><pose>" + pose +
         "</pose><link name=\"l\"><collision name=\"c\"><geometry>" + geometry +
         "</geometry></collision></link></model>\n";
}
const std::string plane = "<plane><normal>0 0 1</normal></plane>";

TEST(Sdf, AWorldHasGroundObstaclesAndRobots) {
  const std::string world =
      "<world name=\"yard\"><gravity>0 0 -9.8</gravity>" +
      static_model("floor", "0 0 0.1 0 0 0", plane) +
      static_model("step", "1 0 0.05 0 0 0.3", "<box><size>0.5 1 0.1</size></box>") +
      "<model name=\"crate\"><pose>0 0 0.4 0 0 0</pose>" + link("l", "", 2., box_collision) +
      "</model><include><uri>model://arms/left</uri><name>left</name><pose>0 1 2 0 0 0</pose>"
      "</include></world>";
  const Loaded loaded = load_sdf(
      {{"robot.sdf", sdf(world)},
       {"arms/left/model.config",
        "<model><sdf version=\"1.4\">old.sdf</sdf><sdf version=\"1.7\">new.sdf</sdf></model>"},
       {"arms/left/new.sdf", model(link("base") + link("tip", "<pose>0 0 1 0 0 0</pose>") +
                                   joint("to_world", "world", "base", "", "fixed") +
                                   joint("j", "base", "tip", "<axis><xyz>0 1 0</xyz></axis>"))}});
  ASSERT_TRUE(loaded.experiment) << loaded.diagnostics;
  const simulation::Experiment& experiment = *loaded.experiment;
  ASSERT_TRUE(experiment.terrain);
  EXPECT_EQ(experiment.terrain->name, "floor");
  ASSERT_EQ(experiment.obstacles.size(), 1u);
  EXPECT_EQ(experiment.obstacles[0].name, "step");
  expect_near(experiment.obstacles[0].location, {1., 0., 0.05});
  ASSERT_EQ(experiment.robots.size(), 2u);
  EXPECT_EQ(experiment.robots[0].name, "crate");
  expect_near(experiment.robots[0].location, {0., 0., 0.4});
  EXPECT_EQ(experiment.robots[1].name, "left");
  EXPECT_FALSE(experiment.robots[1].mobile);
  const auto& hip = experiment.robots[1].chains.at(0);
  expect_near(hip.hip_distance, {0., 1., 3.});
  EXPECT_TRUE(testing::has(loaded.diagnostics, "<gravity> of <world>")) << loaded.diagnostics;
}

// What stands fixed stands where the file has it, too.
TEST(Sdf, AFixedBaseStandsAtItsPose) {
  const Loaded loaded =
      load_sdf({{"robot.sdf", model("<pose>1 2 3 0 0 0.5</pose>" + link("a") + link("b") +
                                    joint("j", "a", "b", "<axis><xyz>0 1 0</xyz></axis>"))}},
               "base = fixed");
  ASSERT_TRUE(loaded.experiment) << loaded.diagnostics;
  const simulation::RobotSpec& robot = loaded.experiment->robots.at(0);
  EXPECT_FALSE(robot.mobile);
  expect_near(robot.location, {1., 2., 3.});
  expect_near(rotate(robot.orientation, {1., 0., 0.}), {std::cos(0.5), std::sin(0.5), 0.});
}

// The first file that is listed is not the model of this one's package, nor the oldest; a light is none.
TEST(Sdf, IncludesAreFoundAsGazeboFindsThem) {
  const std::string ground = model(
      "<static>true</static>" + std::string("<link name=\"l\"><collision name=\"c\"><geometry>") +
      plane + "</geometry></collision></link>");
  const Loaded loaded = load_sdf(
      {{"robot.sdf",
        sdf("<world name=\"w\"><include><uri>model://sun</uri></include><include><uri>model://floor"
            "</uri></include><model name=\"b\">" +
            link("l") + "</model></world>")},
       {"package.xml", "<package/>"},
       {"model.config", "<model><sdf version=\"1.6\">other.sdf</sdf></model>"},
       {"other.sdf", model(link("wrong"))},
       {"sun/model.config", "<model><sdf version=\"1.6\">model.sdf</sdf></model>"},
       {"sun/model.sdf", sdf("<light name=\"sun\" type=\"directional\"/>")},
       {"floor/model.config",
        "<model><sdf version=\"1.6\">new.sdf</sdf><sdf version=\"1.4\">old.sdf</sdf></model>"},
       {"floor/new.sdf", ground},
       {"floor/old.sdf", model(link("wrong"))}});
  ASSERT_TRUE(loaded.experiment) << loaded.diagnostics;
  EXPECT_TRUE(loaded.experiment->terrain);
  EXPECT_EQ(loaded.experiment->robots.size(), 1u);
  EXPECT_TRUE(testing::has(loaded.diagnostics, "included light or actor (1)"))
      << loaded.diagnostics;
}

// A mimic in a nested model names a joint there; before 1.7 a joint may be called like its link.
TEST(Sdf, NamesAreThoseOfTheScope) {
  const std::string inner =
      "<model name=\"hand\">" + link("palm") + link("one") + link("two") +
      joint("j1", "palm", "one", "<axis><xyz>0 0 1</xyz></axis>") +
      joint("j2", "one", "two",
            "<axis><xyz>0 0 1</xyz><mimic joint=\"j1\"><multiplier>3</multiplier></mimic></axis>") +
      "</model>";
  const Loaded nested = load_sdf(
      {{"robot.sdf", model(link("a") + inner + joint("j", "a", "hand::palm", "", "fixed"))}});
  ASSERT_TRUE(nested.experiment) << nested.diagnostics;
  ASSERT_EQ(nested.experiment->couplings.size(), 1u);
  EXPECT_EQ(nested.experiment->couplings[0].ratio, 3.);
  const std::string old =
      link("a") + link("b", "<pose>0 0 1 0 0 0</pose>") +
      joint("b", "a", "b", "<pose>0 0 0.5 0 0 0</pose><axis><xyz>0 1 0</xyz></axis>");
  const Loaded same = load_sdf({{"robot.sdf", model(old, "1.6")}});
  ASSERT_TRUE(same.experiment) << same.diagnostics;
  expect_near(poses_of(same.experiment->robots.at(0)).at("b").position, {0., 0., 1.5});
}

TEST(Sdf, WhatIsEmptyOrHoldsACommentIsReadAsWithout) {
  const Loaded loaded = load_sdf(
      {{"robot.sdf",
        model(
            "<link name=\"a\"><pose/><inertial><mass>1.5<!-- kg --></mass><inertia><ixx></ixx>"
            "</inertia></inertial></link><link name=\"b\"><pose>0 <!-- x --> 0 2 0 0 0</pose></link>" +
            joint(
                "j", "a", "b",
                "<axis><xyz/><limit><lower/><upper></upper></limit><dynamics><damping/></dynamics></axis>"))}});
  ASSERT_TRUE(loaded.experiment) << loaded.diagnostics;
  const simulation::RobotSpec& robot = loaded.experiment->robots.at(0);
  EXPECT_EQ(robot.base.mass.mass, 1.5);
  EXPECT_EQ(robot.base.mass.inertia.xx, 1.);
  EXPECT_FALSE(robot.chains.at(0).links.at(0).lower_limit);
  expect_near(poses_of(robot).at("b").position, {0., 0., 2.});
}

TEST(Sdf, ATiltedPlaneIsASlope) {
  const Loaded loaded = load_sdf(
      {{"robot.sdf", sdf("<world name=\"w\">" + static_model("hill", "0 0 0 0 0.2 0", plane) +
                         "<model name=\"b\">" + link("l") + "</model></world>")}});
  ASSERT_TRUE(loaded.experiment) << loaded.diagnostics;
  const auto* slope = std::get_if<simulation::SlopeSpec>(&loaded.experiment->terrain->surface);
  ASSERT_NE(slope, nullptr);
  EXPECT_NEAR(slope->angle, 0.2, 1e-15);
  EXPECT_NEAR(slope->azimuth, 0., 1e-15);
}

// A box that rests on the plane of the file stands by its own contact: depth m g/(n k).
TEST(Sdf, AModelRestsOnTheGroundOfItsFile) {
  const testing::Workplace place;
  place.file("yard.sdf", sdf("<world name=\"w\">" + static_model("floor", "0 0 0 0 0 0", plane) +
                             "<model name=\"b\"><pose>0 0 0.3 0 0 0</pose>" +
                             link("l", "", 2., box_collision) + "</model></world>"));
  const std::string scene = place.file(
      "scene.hook",
      "World w { deltat = 0.1 ms; duration = 3 s; Include \"yard.sdf\" (contact = file); }\n"
      "Expect rests { of = w.b.base.location.z; equals = 0.299755 m; within = 5 um; }");
  const testing::CommandResult ran = place.hookpoint("run " + scene + " --out out");
  EXPECT_EQ(ran.status, 0) << ran.err << ran.out;
}

struct Wrong {
  const char* name;
  std::string text, place, words;
};
class SdfErrors : public ::testing::TestWithParam<Wrong> {};
TEST_P(SdfErrors, SayWhereAndWhat) {
  const Loaded loaded = load_sdf({{"robot.sdf", GetParam().text}});
  EXPECT_FALSE(loaded.experiment);
  EXPECT_TRUE(testing::has(loaded.diagnostics, "error " + GetParam().place)) << loaded.diagnostics;
  EXPECT_TRUE(testing::has(loaded.diagnostics, GetParam().words)) << loaded.diagnostics;
}
INSTANTIATE_TEST_SUITE_P(
    All, SdfErrors,
    ::testing::Values(
        Wrong{"version", sdf("<model name=\"m\"><link name=\"a\"/></model>", "2.0"), "1:6",
              "SDFormat 1.2 to 1.12 is read, not version \"2.0\""},
        Wrong{"nothing", sdf(""), "1:2", "the file holds no <model>"},
        Wrong{"no_link", model(""), "2:2", "model `m` has no <link>"},
        Wrong{"twice", model(link("a") + link("a")), "4:", "a second `a` in this model"},
        Wrong{"circle",
              model(link("a", "<pose relative_to=\"b\">0 0 0 0 0 0</pose>") +
                    link("b", "<pose relative_to=\"a\">0 0 0 0 0 0</pose>")),
              "3:2", "the pose of `a` is relative to itself"},
        Wrong{"no_frame", model(link("base", "<pose relative_to=\"bose\">0 0 0 0 0 0</pose>")),
              "3:", "there is no link, joint, frame or model `bose` here; did you mean `base`?"},
        Wrong{"pose", model(link("a", "<pose>0 0 0</pose>")), "3:", "<pose> takes six numbers"},
        Wrong{"ball", model(link("a") + link("b") + joint("j", "a", "b", "", "ball")),
              "5:", "a ball joint is not read: write three revolute joints"},
        Wrong{"type", model(link("a") + link("b") + joint("j", "a", "b", "", "hinge")),
              "5:", "`hinge` is no type of joint"},
        Wrong{"loop",
              model(link("a") + link("b") + joint("j", "a", "b", "") + joint("k", "a", "b", "")),
              "6:2", "link `b` is the child of a second joint"},
        Wrong{"axis",
              model(link("a") + link("b") + joint("j", "a", "b", "<axis><xyz>0 0 0</xyz></axis>")),
              "5:", "an axis of length 0 has no direction"},
        Wrong{"limits",
              model(link("a") + link("b") +
                    joint("j", "a", "b",
                          "<axis><limit><lower>1</lower><upper>0</upper></limit></axis>")),
              "5:", "lower = 1 is not below upper = 0"},
        Wrong{"server",
              sdf("<world name=\"w\"><include><uri>https://fuel/x</uri></include></world>"),
              "2:", "lies on a server"},
        Wrong{"missing", sdf("<world name=\"w\"><include><uri>model://x</uri></include></world>"),
              "2:", "there is no model `model://x`"},
        Wrong{"itself", sdf("<world name=\"w\"><include><uri>robot.sdf</uri></include></world>"),
              "2:", "`robot.sdf` includes itself"},
        Wrong{"inertia",
              model("<link name=\"a\"><inertial><mass>1</mass><inertia><ixx>1</ixx><iyy>1</iyy>"
                    "<izz>3</izz></inertia></inertial></link>"),
              "3:", "inertia"},
        Wrong{"plane",
              sdf("<world name=\"w\">" + static_model("f", "0 0 1 0 0.2 0", plane) + "</world>"),
              "2:", "a plane that is tilted is read where it goes through the world's origin"},
        Wrong{"size",
              model(link("a", "", 1.,
                         "<collision name=\"c\"><geometry><sphere><radius>0</radius>"
                         "</sphere></geometry></collision>")),
              "3:", "<radius> of <sphere> is greater than 0"}),
    [](const auto& wrong) { return std::string(wrong.param.name); });

#ifdef HOOKPOINT_HAS_SDFORMAT

/// Where libsdformat has each joint, its axis and the centre of mass of what it carries, in the model.
struct Placed {
  Vector3d anchor, axis, center_of_mass;
  double mass = 0.;
};
std::map<std::string, Placed> placed_by_libsdformat(const std::string& text) {
  sdf::Root root;
  const sdf::Errors errors = root.LoadSdfString(text);
  for (const sdf::Error& error : errors) ADD_FAILURE() << error.Message();
  std::map<std::string, Placed> found;
  const sdf::Model* const of = root.Model();
  const auto vector = [](const auto& v) { return Vector3d{v.X(), v.Y(), v.Z()}; };
  for (std::uint64_t i = 0; i < of->JointCount(); ++i) {
    const sdf::Joint& joint = *of->JointByIndex(i);
    if (joint.Axis() == nullptr) continue;
    ignition::math::Pose3d at;
    EXPECT_TRUE(joint.SemanticPose().Resolve(at, "__model__").empty());
    ignition::math::Vector3d axis;
    EXPECT_TRUE(joint.Axis()->ResolveXyz(axis, "__model__").empty());
    std::string child;
    EXPECT_TRUE(joint.ResolveChildLink(child).empty());
    const sdf::Link& link = *of->LinkByName(child);
    ignition::math::Pose3d link_at;
    EXPECT_TRUE(link.SemanticPose().Resolve(link_at, "__model__").empty());
    found[child] = {vector(at.Pos()), vector(axis),
                    vector((link_at * link.Inertial().Pose()).Pos()),
                    link.Inertial().MassMatrix().Mass()};
  }
  return found;
}

TEST(Sdf, AgreesWithLibsdformat) {
  const std::string frames =
      "<frame name=\"f\" attached_to=\"a\"><pose>0.1 0.2 0.3 0.4 0.5 0.6</pose></frame>\n"
      "<frame name=\"g\"><pose relative_to=\"j\">0.3 -0.2 0.1 0 1 0</pose></frame>\n";
  const std::string text = model(
      frames + link("a", "<pose>0.5 0 0 0.1 0.2 0.3</pose>") +
      link("b", "<pose relative_to=\"f\">0 0.1 0.2 0.7 0 0</pose>", 2.) +
      link("c", "<pose relative_to=\"g\">0.2 0 0 0 0 0.9</pose>", 3.) +
      link("d", "<pose relative_to=\"c\">0 0 0.4 0.2 0 0.1</pose>", 4.) +
      joint("j", "a", "b", "<pose>0.05 0 -0.1 0.3 0.1 0</pose><axis><xyz>1 2 3</xyz></axis>") +
      joint("k", "b", "c",
            "<pose relative_to=\"f\">0.1 0.1 0.1 0 0 0.2</pose><axis><xyz expressed_in=\"a\">0 1 1"
            "</xyz></axis>") +
      joint("l", "c", "d", "<axis><xyz expressed_in=\"g\">1 0 1</xyz></axis>", "prismatic"));
  const auto truth = placed_by_libsdformat(text);
  ASSERT_EQ(truth.size(), 3u);
  const Loaded loaded = load_sdf({{"robot.sdf", text}});
  ASSERT_TRUE(loaded.experiment) << loaded.diagnostics;
  const simulation::RobotSpec& robot = loaded.experiment->robots.at(0);
  // The base stands where link a does in the model, which stands at the world's origin.
  const Pose X_MB{robot.location, robot.orientation};
  const auto poses = poses_of(robot);
  simulation::for_each_link(robot, [&](const simulation::TreeLink& at) {
    const Placed& expected = truth.at(at.link.body.name);
    const Pose X_ML = X_MB * poses.at(at.link.body.name);
    expect_near(X_ML.position, expected.anchor);
    expect_near(rotate(X_ML.orientation, {0., 0., 1.}), (1. / norm(expected.axis)) * expected.axis);
    expect_near((X_ML * Pose{at.link.body.mass.center_of_mass, {}}).position,
                expected.center_of_mass);
    EXPECT_EQ(at.link.body.mass.mass, expected.mass);
  });
}

#endif

}  // namespace
}  // namespace hookpoint::tests
