// What makers write beside what the format's manual says: each is read as its author meant it, with
// a note of what was left out; rotors; macros of xacro.
#include <gtest/gtest.h>

#include <cstdlib>
#include <filesystem>

#include "tests/support/urdf_text.h"

namespace hookpoint::tests {
namespace {

using urdf_text::base, urdf_text::inertial, urdf_text::joint, urdf_text::link_l,
    urdf_text::load_urdf, urdf_text::robot;

const simulation::LinkSpec& first_link(const Loaded& loaded) {
  return loaded.experiment->robots.at(0).chains.at(0).links.at(0);
}

struct Written {
  const char* name;
  std::string text, note;
};
class MakersWriting : public ::testing::TestWithParam<Written> {};

TEST_P(MakersWriting, IsReadWithThisNote) {
  const Loaded loaded = load_urdf(GetParam().text);
  EXPECT_TRUE(loaded.experiment);
  EXPECT_EQ(loaded.diagnostics, GetParam().note);
}

std::string with(const std::string& link_inside, const std::string& joint_inside = "") {
  return robot("<link name=\"l\">" + inertial + link_inside + "</link>\n" +
               joint("j", "continuous", joint_inside));
}
std::string crlf(std::string text) {
  for (std::size_t at = 0; (at = text.find('\n', at)) != std::string::npos; at += 2)
    text.replace(at, 1, "\r\n");
  return text;
}
const std::string plain = robot(link_l + joint("j", "continuous", ""));
const std::string declaration = "<?xml version=\"1.0\" encoding=\"utf-8\"?>\n";
const std::string safety = "<safety_controller k_position=\"1\" k_velocity=\"1\"/>";

const Written writings[] = {
    {"byte_order_mark", "\xEF\xBB\xBF" + declaration + plain, ""},
    {"windows_lines", crlf(declaration + plain), ""},
    {"comment_before_the_declaration", "<!-- by a program -->\n" + declaration + plain, ""},
    {"blanks_before_the_declaration", "\n  " + declaration + plain, ""},
    {"document_type", declaration + "<!DOCTYPE robot [<!ELEMENT robot ANY>]>\n" + plain, ""},
    {"other_encoding_in_a_comment",
     "<?xml version=\"1.0\" encoding=\"gb2312\"?>\n<!-- \xB5\xE7\xBB\xFA -->" + plain, ""},
    {"namespaces_that_nothing_uses",
     "<robot name=\"r\" xmlns:xacro=\"http://www.ros.org/wiki/xacro\" xmlns:sensor=\"x\">" + base +
         link_l + joint("j", "continuous", "") + "</robot>",
     ""},
    {"mujoco_and_materials_of_one_name",
     robot(
         "<mujoco><compiler meshdir=\"m\"/></mujoco><material name=\"m\"/><material name=\"m\"/>" +
         link_l + joint("j", "continuous", "")),
     "note 1:2 left out: <material> (2), <mujoco> (1)\n"},
    {"safety_controller", with("", safety), "note 1:2 left out: <safety_controller> (1)\n"},
    {"effort_of_zero", with("", "<limit effort=\"0\" velocity=\"0\"/>"),
     "note 1:2 left out: limit of effort that is no bound (1), limit of velocity that is no "
     "bound (1)\n"},
    {"effort_without_end", with("", "<limit effort=\"inf\"/>"),
     "note 1:2 left out: limit of effort that is no bound (1)\n"},
    {"effort_beyond_all_numbers", with("", "<limit effort=\"1e400\"/>"),
     "note 1:2 left out: limit of effort that is no bound (1)\n"},
    {"stops_without_end",
     robot(link_l + joint("j", "revolute",
                          "<limit lower=\"-1e+16\" upper=\"1e+16\" effort=\"5\" "
                          "velocity=\"2\"/>")),
     "note 1:2 left out: limit of lower that is no bound (1), limit of upper that is no bound (1)\n"},
    {"limits_of_zero",
     robot(link_l + joint("j", "revolute", "<limit lower=\"0\" upper=\"0\" effort=\"0\"/>")),
     "note 1:2 left out: joint whose limits are equal: fixed (1), limit of effort that is no bound "
     "(1)\n"},
    {"limit_without_ends", robot(link_l + joint("j", "revolute", "<limit effort=\"3\"/>")),
     "note 1:2 left out: limits that joint `j` is not given (1)\n"},
    {"no_limit", robot(link_l + joint("j", "prismatic", "")),
     "note 1:2 left out: limits that joint `j` is not given (1)\n"},
    {"shapes_of_size_zero",
     with("<collision><geometry><cylinder radius=\"0.1\" length=\"0\"/></geometry></collision>"
          "<collision><geometry><sphere radius=\"0\"/></geometry></collision>"
          "<collision><geometry><box size=\"1 0 1\"/></geometry></collision>"),
     "note 1:2 left out: shape of size 0 (3)\n"},
    {"fixed_links_without_inertial",
     robot(link_l + "<link name=\"imu\"/><link name=\"foot\"/>" + joint("j", "continuous", "") +
           joint("k", "fixed", "<axis xyz=\"0 0 0\"/>", "l", "imu") +
           joint("i", "fixed", "", "l", "foot")),
     ""},
    {"fixed_link_of_mass_zero",
     robot(link_l +
           "<link name=\"imu\"><inertial><mass value=\"0\"/><inertia ixx=\"0\" ixy=\"0\" ixz=\"0\" "
           "iyy=\"0\" iyz=\"0\" izz=\"0\"/></inertial></link>" +
           joint("j", "continuous", "") + joint("k", "fixed", "", "l", "imu")),
     ""},
    {"moving_link_that_weighs_nothing",
     robot(link_l + "<link name=\"lidar\"/>" + joint("j", "continuous", "") +
           joint("k", "continuous", "", "b", "lidar")),
     "note 1:2 left out: joint that carries no mass: fixed (1)\n"},
    {"products_of_inertia_that_are_not_given",
     robot("<link name=\"l\"><inertial><mass value=\"1\"/><inertia ixx=\"1\" iyy=\"1\" izz=\"1\" "
           "ixz=\"0\"/></inertial></link>" +
           joint("j", "continuous", "")),
     "note 1:2 left out: product of inertia that is not given: 0 (2)\n"},
    {"link_without_mass_between_two_joints",
     robot("<link name=\"l\"/><link name=\"m\">" + inertial + "</link>" +
           joint("j", "continuous", "") +
           joint("k", "continuous", "<axis xyz=\"0 0 1\"/>", "l", "m")),
     ""},
    {"root_that_weighs_nothing",
     "<robot name=\"r\"><link name=\"b\"/>" + link_l + joint("j", "continuous", "") + "</robot>",
     "note 1:18 link `b`, the base, has no <inertial>: it is fixed\n"},
    {"joint_called_base", robot(link_l + joint("base", "continuous", "")), ""},
    {"rotor_link",
     robot(link_l + "<link name=\"rotor\">" + inertial + "</link>" + joint("j", "continuous", "") +
           joint("k", "fixed", "", "b", "rotor")),
     ""},
    {"capital_letters_and_other_signs",
     "<robot name=\"Go-2 (new)\"><link name=\"Base Link\">" + inertial +
         "</link><link "
         "name=\"FL.Hip\">" +
         inertial + "</link>" + joint("FL Hip-Joint", "continuous", "", "Base Link", "FL.Hip") +
         "</robot>",
     ""},
    {"exponents_and_signs",
     robot(link_l +
           joint("j", "continuous", "<origin xyz=\"+1.E-05 -.5 1e-6\" rpy=\" 0  -0 0 \"/>")),
     ""},
    {"surface_of_which_a_part_is_read",
     robot("<gazebo reference=\"l\"><mu1>1.0</mu1><mu2>0.01</mu2><fdir1>1 0 0</fdir1>"
           "<minDepth>0.003</minDepth><selfCollide>true</selfCollide></gazebo>"
           "<gazebo reference=\"b\"><mu1>0.5</mu1><mu2>0.5</mu2></gazebo>" +
           link_l + joint("j", "continuous", "")),
     "note 1:2 left out: <fdir1> of <gazebo> (1), <minDepth> of <gazebo> (1), <selfCollide> of "
     "<gazebo> (1), mu2 that is not mu1 (1)\n"},
    {"contact_of_which_a_part_is_read",
     with("<contact><lateral_friction value=\"0.8\"/><contact_cfm value=\"0.1\"/><contact_erp "
          "value=\"0.2\"/><inertia_scaling value=\"3\"/><friction_anchor/></contact>"),
     "note 1:2 left out: <contact_cfm> of <contact> (1), <contact_erp> of <contact> (1), "
     "<friction_anchor> of <contact> (1), <inertia_scaling> of <contact> (1)\n"},
    {"transmission_of_two_joints",
     robot(link_l + joint("j", "continuous", "") +
           "<transmission name=\"t\"><joint name=\"j\"/><joint name=\"k\"/><actuator name=\"a\">"
           "<motorInertia>1e-3</motorInertia></actuator></transmission>"),
     "note 1:2 left out: further <joint> of a <transmission> (1)\n"},
};
INSTANTIATE_TEST_SUITE_P(Writings, MakersWriting, ::testing::ValuesIn(writings),
                         [](const auto& of) { return of.param.name; });

TEST(UrdfMakers, AnEffortIsALimitOfTheDrive) {
  const Loaded loaded = load_urdf(with("", "<limit effort=\"23.7\" velocity=\"30\"/>"));
  ASSERT_TRUE(loaded.experiment) << loaded.diagnostics;
  EXPECT_EQ(first_link(loaded).effort_limit, 23.7);
  EXPECT_EQ(first_link(loaded).velocity_limit, 30.);
  EXPECT_FALSE(first_link(load_urdf(with("", "<limit effort=\"0\"/>"))).effort_limit);
  EXPECT_FALSE(first_link(load_urdf(with("", "<limit velocity=\"0\"/>"))).velocity_limit);
  EXPECT_FALSE(load_urdf(with("", "<limit effort=\"strong\"/>")).experiment);
}

// Without end, or beyond all numbers: no stop on that side. On the other side it would be no joint.
TEST(UrdfMakers, AStopWithoutEndIsNone) {
  const auto stops = [](const std::string& type, const char* lower, const char* upper) {
    return load_urdf(robot(link_l + joint("j", type,
                                          std::string("<limit lower=\"") + lower + "\" upper=\"" +
                                              upper + "\" effort=\"1\" velocity=\"1\"/>")));
  };
  for (const char* type : {"revolute", "prismatic"}) {
    for (const auto& [lower, upper] :
         {std::pair{"-1e+16", "1e+16"}, std::pair{"-inf", "inf"}, std::pair{"-INFINITY", "+Inf"},
          std::pair{"-1e400", " 1e400 "}, std::pair{"-1.0000001e12", "1.0000001e12"}}) {
      const Loaded loaded = stops(type, lower, upper);
      ASSERT_TRUE(loaded.experiment) << loaded.diagnostics;
      EXPECT_FALSE(first_link(loaded).lower_limit || first_link(loaded).upper_limit) << lower;
    }
    const Loaded below = stops(type, "-0.5", "inf"), above = stops(type, "-1e16", "0.25");
    EXPECT_EQ(first_link(below).lower_limit, -0.5);
    EXPECT_FALSE(first_link(below).upper_limit);
    EXPECT_FALSE(first_link(above).lower_limit);
    EXPECT_EQ(first_link(above).upper_limit, 0.25);
    for (const auto& [lower, upper] : {std::pair{"inf", "1"}, std::pair{"-1", "-1e16"},
                                       std::pair{"nan", "1"}, std::pair{"-0x1p99", "1"}})
      EXPECT_FALSE(stops(type, lower, upper).experiment) << lower << ' ' << upper;
  }
}

/// What counts of the surface of the first link, that is a ball.
contact::MaterialConstants<double> surface(const std::string& link_inside,
                                           const std::string& outside) {
  const Loaded loaded =
      load_urdf(robot(outside + "<link name=\"l\">" + inertial +
                      "<collision><geometry><sphere radius=\"0.1\"/></geometry></collision>" +
                      link_inside + "</link>\n" + joint("j", "continuous", "")),
                ", contact = file");
  EXPECT_TRUE(loaded.experiment) << loaded.diagnostics;
  const int material = first_link(loaded).body.shapes.at(0).material;
  return loaded.experiment->materials.at(static_cast<std::size_t>(material)).constants;
}

// As sdformat's converter of URDF: each block adds what it states, and the last value of two counts.
TEST(UrdfMakers, EachStatementOfASurfaceCounts) {
  const auto two = surface("",
                           "<gazebo reference=\"l\"><mu1>0.6</mu1></gazebo><gazebo "
                           "reference=\"l\"><kp>100000</kp><kd>100</kd></gazebo>");
  EXPECT_EQ(two.static_friction, 0.6);
  EXPECT_EQ(two.normal_stiffness, 1e5);
  EXPECT_EQ(two.normal_damping, 100.);
  const auto both = surface(
      "<contact><lateral_friction value=\"0.8\"/><stiffness value=\"30000\"/><damping "
      "value=\"1000\"/></contact>",
      "<gazebo reference=\"l\"><kp>1e6</kp><kd>0</kd></gazebo>");
  EXPECT_EQ(both.kinetic_friction, 0.8);
  EXPECT_EQ(both.normal_stiffness, 1e6);
  EXPECT_EQ(both.normal_damping, 1000.);
  const Loaded changed = load_urdf(robot(
      "<gazebo reference=\"l\"><mu1>0.6</mu1></gazebo><gazebo reference=\"l\"><mu1>0.7</mu1></gazebo>" +
      link_l + joint("j", "continuous", "")));
  EXPECT_EQ(
      changed.diagnostics,
      "note 1:2 left out: constant of a surface that is stated again with another value (1)\n");
}

// Gazebo's own kp is 1e13, and friction without end is inf: the largest number, as an SDF's.
TEST(UrdfMakers, ASurfaceWithoutEndHasTheLargestNumber) {
  constexpr double largest = 1e12;
  for (const char* endless : {"1e+13", "inf", "1e400"}) {
    const std::string text = endless;
    const auto read = surface(
        "", "<gazebo reference=\"l\"><mu1>" + text + "</mu1><kp value=\"" + text + "\"/></gazebo>");
    EXPECT_EQ(read.static_friction, largest);
    EXPECT_EQ(read.normal_stiffness, largest);
    EXPECT_EQ(
        surface("<contact><stiffness value=\"" + text + "\"/></contact>", "").normal_stiffness,
        largest);
  }
  for (const char* wrong : {"-1", "-inf", "nan", "hard"})
    EXPECT_FALSE(load_urdf(robot("<gazebo reference=\"l\"><mu1>" + std::string(wrong) +
                                 "</mu1></gazebo>" + link_l + joint("j", "continuous", "")))
                     .experiment)
        << wrong;
}

/// N^2 I: 6.33^2 x 1e-3; what the Include says goes before it.
TEST(UrdfMakers, ARotorIsSeenThroughItsGears) {
  const auto text = [](const std::string& motor) {
    return robot(link_l + joint("j", "continuous", "") +
                 "<transmission name=\"t\"><joint name=\"j\"/><actuator name=\"a\">" + motor +
                 "</actuator></transmission>");
  };
  const std::string gears =
      "<mechanicalReduction> 6.33 </mechanicalReduction><motorInertia>1e-3</motorInertia>";
  const Loaded loaded = load_urdf(text(gears));
  ASSERT_TRUE(loaded.experiment) << loaded.diagnostics;
  EXPECT_EQ(loaded.diagnostics, "");
  EXPECT_DOUBLE_EQ(first_link(loaded).rotor_inertia, 6.33 * 6.33 * 1e-3);
  EXPECT_DOUBLE_EQ(first_link(load_urdf(text("<drake:rotor_inertia value=\"2e-3\"/>"
                                             "<drake:gear_ratio value=\"3\"/>")))
                       .rotor_inertia,
                   9. * 2e-3);
  // Gears of the joint: 100^2 x 1e-4, and both: (6.33 x 2)^2 x 1e-3.
  const auto of_joint = [](const std::string& gear, const std::string& motor) {
    return first_link(load_urdf(robot(link_l + joint("j", "continuous", "") +
                                      "<transmission name=\"t\"><joint name=\"j\">" + gear +
                                      "</joint><actuator name=\"a\">" + motor +
                                      "</actuator></transmission>")))
        .rotor_inertia;
  };
  EXPECT_DOUBLE_EQ(of_joint("<mechanicalReduction>100</mechanicalReduction>",
                            "<motorInertia>1e-4</motorInertia>"),
                   1.);
  EXPECT_DOUBLE_EQ(of_joint("<mechanical_reduction>2</mechanical_reduction>", gears),
                   12.66 * 12.66 * 1e-3);
  EXPECT_EQ(first_link(load_urdf(text(gears), ", rotor_inertia = 0.25 kg.m^2")).rotor_inertia,
            0.25);
  EXPECT_EQ(first_link(load_urdf(text(gears), ", rotor_inertia = 0.25, j_rotor_inertia = 0.5"))
                .rotor_inertia,
            0.5);
  const Loaded none = load_urdf(text("<mechanicalReduction>9</mechanicalReduction>"));
  EXPECT_EQ(first_link(none).rotor_inertia, 0.);
  EXPECT_EQ(none.diagnostics, "note 1:2 left out: <transmission> (1)\n");
  for (const char* wrong : {", rotor_inertia = 1 kg", ", j_rotor_inertia = -1",
                            ", j_rotor_inertia = much", ", k_rotor_inertia = 1"})
    EXPECT_FALSE(load_urdf(text(gears), wrong).experiment) << wrong;
  EXPECT_FALSE(load_urdf(text("<motorInertia>-1</motorInertia>")).experiment);
}

/// A folder ahead of all others in PATH, with a program `xacro` in it while a test lasts.
class Xacro : public ::testing::Test, protected testing::Workplace {
 protected:
  Xacro() : path_(std::getenv("PATH")) {
    std::filesystem::create_directory(folder() / "bin");
    setenv("PATH", (folder() / "bin").c_str(), 1);
  }
  ~Xacro() override { setenv("PATH", path_.c_str(), 1); }

  void program(const std::string& script) {
    std::filesystem::permissions(file("bin/xacro", "#!/bin/sh\nPATH=/usr/bin:/bin\n" + script),
                                 std::filesystem::perms::owner_all);
  }
  Loaded load(const std::string& name, const std::string& text, const std::string& arguments = "") {
    file(name, text);
    return load_file(
        file("scene.hook", "World w { Include \"" + name + "\" (name = r" + arguments + "); }"));
  }
  const std::string macros_ =
      "<robot name=\"r\" xmlns:xacro=\"http://www.ros.org/wiki/xacro\">\n<xacro:arg name=\"arm\" "
      "default=\"false\"/><xacro:leg side=\"1\"/></robot>";

 private:
  std::string path_;
};

TEST_F(Xacro, IsExpandedByItsProgram) {
  file("whole.urdf", plain);
  program("cat \"$(dirname \"$1\")/whole.urdf\"");
  for (const char* name : {"r.xacro", "r.urdf.xacro", "r.urdf"}) {
    const Loaded loaded = load(name, macros_);
    ASSERT_TRUE(loaded.experiment) << loaded.diagnostics;
    EXPECT_EQ(first_link(loaded).body.name, "l");
  }
}

TEST_F(Xacro, GetsArgumentsAsTheyAreAndOnlyItsOwn) {
  file("whole.urdf", plain);
  program(
      "cd \"$(dirname \"$1\")\"; shift; for word; do echo \"$word\"; done > words; cat whole.urdf");
  const Loaded loaded =
      load("r.xacro", macros_, ", arm = \"a b;$(touch stolen)'`id`\", j = 0.5 rad");
  ASSERT_TRUE(loaded.experiment) << loaded.diagnostics;
  EXPECT_EQ(read("words"), "arm:=a b;$(touch stolen)'`id`\n");
  EXPECT_FALSE(std::filesystem::exists(folder() / "stolen"));
  EXPECT_EQ(first_link(loaded).angle, 0.5);
  EXPECT_FALSE(load("r.xacro", macros_, ", leg = 1").experiment);
}

TEST_F(Xacro, SaysWhatItsProgramSaysWhereItFails) {
  program("echo 'no such macro: leg' >&2; echo 'when processing r.xacro' >&2; exit 2");
  const auto first_line = [&] {
    const std::string diagnostics = load("r.xacro", macros_).diagnostics;
    return diagnostics.substr(0, diagnostics.find('\n'));
  };
  EXPECT_EQ(first_line(),
            "error 2:2 xacro ended with status 2: no such macro: leg; when processing r.xacro");
  program("echo '<robot>'");
  EXPECT_EQ(first_line(), "error 1:8 this is not XML: Start-end tags mismatch");
}

TEST_F(Xacro, IsAskedForWhereItIsNotInstalled) {
  const Loaded loaded = load("r.xacro", macros_);
  EXPECT_EQ(loaded.diagnostics.find(
                "error 2:2 the macros of xacro need its program, which is not installed"),
            0u)
      << loaded.diagnostics;
  EXPECT_TRUE(load("r.urdf", plain).experiment);
}

}  // namespace
}  // namespace hookpoint::tests
