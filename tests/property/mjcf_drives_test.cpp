// Actuators and springs of an MJCF: what becomes of them against what MuJoCo 3.14 compiles of the same
// text (model.actuator_gainprm, actuator_biasprm, jnt_stiffness, dof_damping), and sums of actuators
// against a closed form.
#include <fmt/format.h>
#include <gtest/gtest.h>

#include <cmath>
#include <optional>
#include <regex>
#include <string>

#include "tests/support/command.h"
#include "tests/support/mjcf_text.h"

namespace hookpoint::tests {
namespace {

/// The controller of a robot's only servo, as it is printed.
struct Servo {
  double gain = 0., damping = 0., goal = 0.;
  std::string text;
};

double printed_number(const std::string& text, const std::string& field) {
  std::smatch found;
  const std::regex pattern("[^a-z_]" + field + " = ([-+0-9.e]+)");
  return std::regex_search(text, found, pattern) ? std::stod(found[1]) : 0.;
}

Servo servo_of(const std::string& text, const std::string& arguments = "") {
  const testing::Workplace place;
  place.file("robot.xml", text);
  place.file("scene.hook", "World w { Include \"robot.xml\" (name = r" + arguments + "); }");
  const std::string printed = place.hookpoint("print scene.hook").out;
  const std::size_t at = printed.find("Controller.PD");
  if (at == std::string::npos) return {0., 0., 0., printed};
  const std::string servo = printed.substr(at, printed.find('}', at) - at);
  return {printed_number(servo, "pconstant"), printed_number(servo, "dconstant"),
          printed_number(servo, "goal"), printed};
}

void expect_near(double found, double expected) {
  EXPECT_NEAR(found, expected, 1e-5 * std::abs(expected));
}

/// A ball of 0.1 m whose joint is 0.3 m above it, or an `arm`.
std::string ball_on_joint(const std::string& before, const std::string& actuators,
                          const std::string& joint = "") {
  return "<mujoco><compiler angle=\"radian\"/>" + before +
         "<worldbody><body name=\"base\"><joint name=\"j\" axis=\"0 1 0\" pos=\"0 0 0.3\" " +
         joint + "/><geom size=\"0.1\"/></body></worldbody><actuator>" + actuators + "</actuator>";
}
const std::string end = "</mujoco>";
const std::string arm =
    "<worldbody><body name=\"arm\" childclass=\"g\"><joint name=\"j\" axis=\"0 1 0\" range=\"-1 1\" "
    "armature=\"0.01\"/><geom type=\"capsule\" size=\"0.02\" fromto=\"0 0 0 0 0 -0.5\" "
    "mass=\"2\"/></body></worldbody>";

struct OfClass {
  const char* actuator;
  double gain, damping;
};

TEST(MjcfDrives, ActuatorsOfAllTagsShareADefault) {
  const std::string defaults =
      "<default><position kp=\"100\" kv=\"3\"/><default class=\"v\"><velocity kv=\"7\"/></default>"
      "<default class=\"g\"><general biasprm=\"0 -5\"/></default><default class=\"mo\"><motor "
      "gear=\"2\"/></default><default class=\"dr\"><position dampratio=\"1\"/></default></default>";
  // Gain and damping of the joint: gear^2 times those of MuJoCo 3.14.
  const OfClass rows[] = {
      {"<general joint=\"j\"/>", 100., 3.},
      {"<velocity joint=\"j\"/>", 100., 0.},
      {"<motor joint=\"j\"/>", 0., 0.},
      {"<position joint=\"j\" kp=\"9\"/>", 9., 3.},
      {"<general joint=\"j\" class=\"v\"/>", 7., 0.},
      {"<position joint=\"j\" class=\"v\"/>", 7., 7.},
      {"<general joint=\"j\" class=\"g\"/>", 0., 0.},
      {"<position joint=\"j\" class=\"mo\"/>", 4., 12.},
      {"<position joint=\"j\" class=\"dr\"/>", 100., 12.549841102578487},
      {"<position joint=\"j\" class=\"dr\" kv=\"2\"/>", 100., 2.},
      {"<position joint=\"j\" class=\"dr\" gear=\"3\"/>", 900., 9. * 4.183280367526161},
  };
  for (const OfClass& row : rows) {
    const Servo servo = servo_of(ball_on_joint(defaults, row.actuator) + end);
    SCOPED_TRACE(row.actuator + servo.text);
    expect_near(servo.gain, row.gain);
    expect_near(servo.damping, row.damping);
  }
}

TEST(MjcfDrives, ADampingRatioIsOfTheInertiaBeforeTheJoint) {
  for (const char* actuator :
       {"<position joint=\"j\" class=\"g\" kp=\"500\" dampratio=\"1\"/>",
        "<general joint=\"j\" biastype=\"affine\" gainprm=\"500\" biasprm=\"0 -500 1\"/>"}) {
    const Servo servo = servo_of(
        "<mujoco><compiler angle=\"radian\"/><default><default "
        "class=\"g\"/></default>" +
        arm + "<actuator>" + actuator + "</actuator>" + end);
    SCOPED_TRACE(servo.text);
    expect_near(servo.gain, 500.);
    expect_near(servo.damping, 19.05108389221869);
  }
}

TEST(MjcfDrives, SpringsAndRatiosCountMassesTogetherAndTheBaseMoves) {
  const std::string text =
      "<mujoco><compiler settotalmass=\"10\" angle=\"radian\"/><default><joint springdamper=\"0.1 "
      "0.7\"/></default><worldbody><body name=\"t\" pos=\"0 0 1\"><freejoint/><geom size=\"0.1\" "
      "mass=\"1\"/><body name=\"u\"><joint name=\"j\" axis=\"0 1 0\" ref=\"0.4\" stiffness=\"3\" "
      "armature=\"0.02\"/><geom size=\"0.1\" pos=\"0.3 0 0\" mass=\"0.5\"/><body name=\"v\" pos=\"0.3 "
      "0 0.1\"><joint name=\"k\" axis=\"0 1 0\" armature=\"0.1\" springdamper=\"0 0\"/><geom "
      "size=\"0.1\" pos=\"0.3 0 0\" mass=\"0.5\"/></body></body></body></worldbody><actuator>"
      "<position joint=\"j\" kp=\"40\" dampratio=\"0.5\" gear=\"-2\"/></actuator></mujoco>";
  const Loaded loaded = load_mjcf(text);
  ASSERT_TRUE(loaded.experiment) << loaded.diagnostics;
  const auto& links = loaded.experiment->robots.at(0).chains.at(0).links;
  EXPECT_NEAR(links.at(0).stiffness, 7.944522116941164, 1e-9);
  EXPECT_NEAR(links.at(0).damping, 0.7785631674602341, 1e-10);
  EXPECT_EQ(links.at(1).stiffness, 0.);
  expect_near(servo_of(text).damping, 4. * 3.449637662132068);
  EXPECT_EQ(loaded.diagnostics.find("springdamper"), std::string::npos) << loaded.diagnostics;
}

TEST(MjcfDrives, CtrlStaysInItsRange) {
  const auto goal = [&](const std::string& actuator, double ctrl) {
    return servo_of(ball_on_joint("", actuator, "range=\"-0.5 1.5\"") +
                        fmt::format("<keyframe><key name=\"k\" ctrl=\"{}\"/></keyframe>", ctrl) +
                        end,
                    ", keyframe = k")
        .goal;
  };
  const std::string servo = "<position joint=\"j\" kp=\"100\" ";
  EXPECT_EQ(goal(servo + "ctrlrange=\"-0.2 0.2\"/>", 0.5), 0.2);
  EXPECT_EQ(goal(servo + "ctrlrange=\"-0.2 0.2\" ctrllimited=\"false\"/>", 0.5), 0.5);
  EXPECT_EQ(goal(servo + "ctrlrange=\"-inf 0.2\"/>", -3.), -3.);
  // Half the range about its middle, 0.5: 0 to 1.
  expect_near(goal(servo + "inheritrange=\"0.5\"/>", 2.), 1.);
}

// kp (u - q) - kv q' and kv (w - q') are kp (u + kv w / kp - q) - 2 kv q'.
TEST(MjcfDrives, ActuatorsOfOneJointAddUp) {
  const std::string position = "<position joint=\"j\" kp=\"100\" kv=\"2\"/>",
                    velocity = "<velocity joint=\"j\" kv=\"10\"/>";
  for (const bool first : {true, false}) {
    const Servo servo =
        servo_of(ball_on_joint("", first ? position + velocity : velocity + position) +
                     "<keyframe><key name=\"k\" ctrl=\"" + (first ? "0.1 0.5" : "0.5 0.1") +
                     "\"/></keyframe>" + end,
                 ", keyframe = k");
    SCOPED_TRACE(servo.text);
    expect_near(servo.gain, 100.);
    expect_near(servo.damping, 12.);
    expect_near(servo.goal, 0.15);
  }
  const Loaded limited = load_mjcf(ball_on_joint("",
                                                 "<position joint=\"j\" forcerange=\"-5 5\"/>"
                                                 "<velocity joint=\"j\" forcerange=\"-2 2\"/>") +
                                   end);
  ASSERT_TRUE(limited.experiment) << limited.diagnostics;
  EXPECT_EQ(limited.experiment->robots.at(0).chains.at(0).links.at(0).effort_limit, 7.);
  EXPECT_NE(limited.diagnostics.find("limits of several actuators"), std::string::npos);
}

TEST(MjcfDrives, WhatIsLostOfRangesAndCtrlIsNoted) {
  const Loaded loaded =
      load_mjcf(ball_on_joint("", "<motor joint=\"j\" ctrlrange=\"-1 3\" forcerange=\"-1 20\"/>",
                              "actuatorfrcrange=\"-4 5\"") +
                    "<keyframe><key name=\"k\" ctrl=\"1\"/></keyframe>" + end,
                ", keyframe = k");
  ASSERT_TRUE(loaded.experiment) << loaded.diagnostics;
  EXPECT_EQ(loaded.experiment->robots.at(0).chains.at(0).links.at(0).effort_limit, 3.);
  for (const char* lost :
       {"smaller end of ctrlrange of <motor>", "smaller end of forcerange of <motor>",
        "smaller end of actuatorfrcrange of <joint>", "ctrl of a motor in the <key>"})
    EXPECT_NE(loaded.diagnostics.find(lost), std::string::npos) << lost << loaded.diagnostics;
}

}  // namespace
}  // namespace hookpoint::tests
