// Joints of a URDF or MJCF that follow others or are locked, and inertias that are repaired.
#include <fmt/format.h>
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <random>
#include <string>
#include <vector>

#include "simulation/experiment/robot_tree.h"
#include "tests/support/run_text.h"
#include "tests/support/urdf_text.h"

namespace hookpoint {
namespace {

using urdf_text::joint, urdf_text::load_urdf, urdf_text::robot;

constexpr double g = 9.81;

std::string inertial(double mass, const std::string& moments, const std::string& at = "0 0 0") {
  const auto number = [&](int i) {
    std::size_t begin = 0;
    for (; i > 0; --i) begin = moments.find(' ', begin) + 1;
    return moments.substr(begin, moments.find(' ', begin) - begin);
  };
  return fmt::format(
      "<inertial><origin xyz=\"{}\"/><mass value=\"{}\"/><inertia ixx=\"{}\" iyy=\"{}\" izz=\"{}\" "
      "ixy=\"0\" ixz=\"0\" iyz=\"0\"/></inertial>",
      at, mass, number(0), number(1), number(2));
}
std::string link(const std::string& name, const std::string& inside) {
  return "<link name=\"" + name + "\">" + inside + "</link>\n";
}
std::string on_the_world(const std::string& inside) {
  return "<robot name=\"r\">\n<link name=\"world\"/>\n" + inside + "</robot>";
}

/// A weight of 2 kg that slides downward from 0.05 m and a drum of 0.03 kg m^2 and radius 0.1 m.
const std::string drum = on_the_world(
    link("weight", inertial(2., "1 1 1")) + link("drum", inertial(1., "1 1 0.03")) +
    joint("rope", "prismatic",
          "<axis xyz=\"0 0 -1\"/><limit lower=\"-9\" upper=\"9\" effort=\"1\"/>", "world",
          "weight") +
    joint("axle", "continuous",
          "<axis xyz=\"0 0 1\"/><mimic joint=\"rope\" multiplier=\"10\" offset=\"0.3\"/>", "world",
          "drum"));

// m a = m g - T, I (a/r) = T r: a = g m / (m + I/r^2).
TEST(UrdfJoints, AWeightTurnsTheDrumThatFollowsIt) {
  Running run(load_urdf(drum, ", rope = 0.05 m"));
  const double a = g * 2. / (2. + 0.03 / 0.01);
  EXPECT_EQ(run["w.r.axle.drum.angle"], 0.3 + 10. * 0.05);
  run.step(100);
  const double t = run["w.time"];
  EXPECT_GT(t, 0.);
  EXPECT_NEAR(run["w.r.rope.weight.rate"], a * t, 1e-10 * a * t);
  EXPECT_NEAR(run["w.r.axle.drum.rate"], 10. * a * t, 1e-9 * a * t);
  EXPECT_NEAR(run["w.r.axle.drum.angle"], 0.3 + 10. * run["w.r.rope.weight.angle"], 1e-12);
}

TEST(UrdfJoints, ItFallsFreelyWhereTheCouplingIsIgnored) {
  Running run(load_urdf(drum, ", mimic = ignore, axle = 0.2 rad"));
  EXPECT_EQ(run["w.r.axle.drum.angle"], 0.2);
  run.step(100);
  const double t = run["w.time"];
  EXPECT_NEAR(run["w.r.rope.weight.rate"], g * t, 1e-10 * g * t);
  EXPECT_EQ(run["w.r.axle.drum.angle"], 0.2);
}

// The drum stands still where the weight is locked: 0.3 + 10 0.07.
TEST(UrdfJoints, WhatFollowsALockedJointIsLocked) {
  const std::string text = on_the_world(
      link("weight", inertial(2., "1 1 1")) +
      link("drum", inertial(1., "1 2 2.5") +
                       "<collision><origin xyz=\"1 0 0\"/><geometry><sphere radius=\"0.1\"/>"
                       "</geometry></collision>") +
      link("arm", inertial(1., "1 1 1")) +
      joint("rope", "prismatic", "<axis xyz=\"0 0 -1\"/><limit lower=\"-9\" upper=\"9\"/>", "world",
            "weight") +
      joint("axle", "continuous",
            "<axis xyz=\"0 0 1\"/><mimic joint=\"rope\" multiplier=\"10\" offset=\"0.3\"/>",
            "world", "drum") +
      joint("elbow", "continuous", "<axis xyz=\"0 0 1\"/>", "drum", "arm"));
  const Loaded loaded = load_urdf(text, ", lock = \"ro*\", rope = 0.07 m");
  ASSERT_TRUE(loaded.experiment) << loaded.diagnostics;
  EXPECT_NE(loaded.diagnostics.find("joint that `lock` fixes (1)"), std::string::npos)
      << loaded.diagnostics;
  const simulation::RobotSpec& read = loaded.experiment->robots.at(0);
  ASSERT_EQ(read.chains.size(), 1u);
  EXPECT_EQ(read.chains[0].name, "elbow");
  ASSERT_EQ(read.base.shapes.size(), 1u);
  EXPECT_NEAR(read.base.shapes[0].location.x, std::cos(1.), 1e-15);
  EXPECT_NEAR(read.base.shapes[0].location.y, std::sin(1.), 1e-15);

  const Loaded wrong = load_urdf(text, ", lock = rop");
  EXPECT_FALSE(wrong.experiment);
  EXPECT_NE(wrong.diagnostics.find("no joint fits `rop`; did you mean `rope`?"), std::string::npos)
      << wrong.diagnostics;
  EXPECT_NE(
      load_urdf(text, ", lock = 3").diagnostics.find("the argument `lock` is names of joints"),
      std::string::npos);
}

// q3 = 2 q2 + 0.1, q2 = -3 q1 + 0.2: q3 = -6 q1 + 0.5.
TEST(UrdfJoints, ATrainOfGearsFollowsItsFirst) {
  const std::string one = inertial(1., "1 1 1");
  Running run(load_urdf(
      on_the_world(
          link("a", one) + link("b", one) + link("c", one) +
          joint("third", "continuous", "<mimic joint=\"second\" multiplier=\"2\" offset=\"0.1\"/>",
                "world", "c") +
          joint("second", "continuous", "<mimic joint=\"first\" multiplier=\"-3\" offset=\"0.2\"/>",
                "world", "b") +
          joint("first", "continuous", "", "world", "a")),
      ", first = 0.4 rad"));
  EXPECT_NEAR(run["w.r.second.b.angle"], -1., 1e-15);
  EXPECT_NEAR(run["w.r.third.c.angle"], -1.9, 1e-15);
}

// An MJCF says the same as <joint> of <equality>, about the joints' references: the two pendulums
// have one degree of freedom, whose energy is kept.
TEST(UrdfJoints, AnEqualityOfAnMjcfCouplesTwoPendulums) {
  const double m1 = 0.7, l1 = 0.4, m2 = 0.5, l2 = 0.3, I = 0.02, ratio = -1.7, offset = 0.4;
  const auto pendulum = [I](const char* name, double m, double l) {
    return fmt::format(
        "<body name=\"{}\"><joint name=\"{}_joint\" axis=\"0 1 0\"/><inertial pos=\"0 0 {}\" "
        "mass=\"{}\" diaginertia=\"{} {} {}\"/></body>",
        name, name, -l, m, I, I, I);
  };
  const testing::Workplace place;
  place.file("robot.xml",
             "<mujoco><worldbody>" + pendulum("first", m1, l1) + pendulum("second", m2, l2) +
                 "</worldbody><equality><joint joint1=\"second_joint\" joint2=\"first_joint\" "
                 "polycoef=\"0.4 -1.7 0 0 0\"/></equality></mujoco>");
  const auto load = [&](const std::string& arguments) {
    return load_file(place.file("scene.hook",
                                "World w { integrator = rk4; deltat = 1 ms; Include \"robot.xml\" "
                                "(name = r, first_joint = 1.2 rad" +
                                    arguments + "); }"));
  };
  const Loaded loaded = load("");
  ASSERT_TRUE(loaded.experiment) << loaded.diagnostics;
  Running run(loaded);
  const std::string robot = "w." + loaded.experiment->robots.at(0).name;
  const auto q1 = run.port(robot + ".first_joint.first.angle"),
             q2 = run.port(robot + ".second_joint.second.angle"),
             rate = run.port(robot + ".first_joint.first.rate");
  const auto energy = [&] {
    const double J = I + m1 * l1 * l1 + ratio * ratio * (I + m2 * l2 * l2);
    return 0.5 * J * *rate.value * *rate.value -
           g * (m1 * l1 * std::cos(*q1.value) + m2 * l2 * std::cos(*q2.value));
  };
  const double start = energy();
  double fastest = 0.;
  for (int i = 0; i < 2000; ++i) {
    ASSERT_NEAR(*q2.value, ratio * *q1.value + offset, 1e-12);
    ASSERT_NEAR(energy(), start, 1e-8) << i;
    fastest = std::max(fastest, std::abs(*rate.value));
    run.step();
  }
  EXPECT_GT(fastest, 0.5);

  const Loaded apart = load(", mimic = ignore");
  ASSERT_TRUE(apart.experiment);
  EXPECT_NE(apart.diagnostics.find("<joint> of <equality> (1)"), std::string::npos);
}

/// A World around robot.FORMAT, whose Include has the arguments.
Loaded load_named(const std::string& format, const std::string& text,
                  const std::string& arguments) {
  const testing::Workplace place;
  place.file("robot." + format, text);
  return load_file(place.file("scene.hook", "World w { deltat = 1 ms; Include \"robot." + format +
                                                "\" (" + arguments + "); }"));
}

// A hand with three fingers, of which the second and third follow others, and whose names are drawn from
// a few: links, joints and the robot are called alike. What leads is what the file says.
TEST(UrdfJoints, NamesThatAreAlikeHideNoLeader) {
  std::mt19937 random(4);
  int coupled = 0, refused = 0;
  for (int round = 0; round < 300; ++round) {
    std::vector<std::string> links{"a", "b", "c", "d", "e", "f"}, joints = links;
    std::ranges::shuffle(links, random);
    std::ranges::shuffle(joints, random);
    const std::string one = inertial(1., "1 1 1");
    std::string text = "<robot name=\"r\">" + link("palm", one);
    std::vector<std::string> bodies{"palm"};
    for (std::size_t i = 0; i < 5; ++i) {
      const std::string mimic = i < 3 ? ""
                                      : "<mimic joint=\"" + joints[i - 3] + "\" multiplier=\"" +
                                            std::to_string(i) + "\"/>";
      text += link(links[i], one) +
              joint(joints[i], "continuous", mimic, bodies[random() % bodies.size()], links[i]);
      bodies.push_back(links[i]);
    }
    const std::string name = round % 2 == 0 ? links[random() % 6] : joints[random() % 6];
    const Loaded loaded = load_named("urdf", text + "</robot>", "name = " + name);
    if (!loaded.experiment) {
      EXPECT_NE(loaded.diagnostics.find("cannot be named from here"), std::string::npos)
          << loaded.diagnostics << text;
      // The message's advice.
      EXPECT_TRUE(load_named("urdf", text + "</robot>", "name = other").experiment) << text;
      ++refused;
      continue;
    }
    std::vector<std::string> names;
    simulation::for_each_link(loaded.experiment->robots.at(0), [&](const simulation::TreeLink& at) {
      names.push_back(at.link.body.name);
    });
    ASSERT_EQ(loaded.experiment->couplings.size(), 2u);
    for (const simulation::CouplingSpec& coupling : loaded.experiment->couplings) {
      const auto follower = std::size_t(coupling.ratio);
      EXPECT_EQ(names.at(coupling.follower), links[follower]) << text;
      EXPECT_EQ(names.at(coupling.leader), links[follower - 3]) << text;
    }
    ++coupled;
  }
  EXPECT_GT(coupled, 200);
  EXPECT_LT(refused, 60);
}

// Links and joints called as their controller, its ports, the robot and the World: it moves as the same
// robot with names that say nothing else.
TEST(UrdfJoints, NamesThatAreAlikeHideNoServo) {
  const auto text = [](const std::vector<std::string>& names) {
    return fmt::format(
        "<mujoco model=\"m\"><compiler angle=\"radian\"/><worldbody><body name=\"{}\" pos=\"0 0 1\">"
        "<freejoint/><geom size=\"0.1\"/><body name=\"{}\"><joint name=\"{}\" axis=\"0 1 0\"/>"
        "<geom size=\"0.05\" pos=\"0 0 -0.2\"/><body name=\"{}\" pos=\"0 0 -0.3\"><joint name=\"{}\" "
        "axis=\"0 1 0\"/><geom size=\"0.05\" pos=\"0 0 -0.2\"/><body name=\"{}\" pos=\"0 0 -0.3\">"
        "<joint name=\"{}\" axis=\"1 0 0\"/><geom size=\"0.05\" pos=\"0 0 -0.2\"/></body></body>"
        "</body></body></worldbody><equality><joint joint1=\"{}\" joint2=\"{}\" polycoef=\"0 -2 0 0 "
        "0\"/></equality><actuator><position joint=\"{}\" kp=\"10\"/><velocity joint=\"{}\" "
        "kv=\"0.3\"/></actuator></mujoco>",
        names[0], names[1], names[2], names[3], names[4], names[5], names[6], names[6], names[2],
        names[2], names[4]);
  };
  const auto angles = [&](const std::vector<std::string>& names, const std::string& robot) {
    const Loaded loaded =
        load_named("xml", text(names), "name = " + robot + ", base = fixed, start = 0.4 rad");
    Running run(loaded);
    run.step(100);
    std::vector<double> found;
    simulation::for_each_link(loaded.experiment->robots.at(0), [&](const simulation::TreeLink& at) {
      found.push_back(run["w." + robot + "." + at.chain.name + "." + at.link.body.name + ".angle"]);
    });
    return found;
  };
  // The second body hangs on joint `start`.
  const auto plain = angles({"body", "first", "start", "second", "j2", "third", "j3"}, "plain");
  EXPECT_GT(std::abs(plain.at(0) - 0.4), 1e-3);
  EXPECT_EQ(angles({"body", "servo", "start", "angle", "rate", "robot", "w"}, "robot"), plain);
  EXPECT_EQ(angles({"body", "start", "start", "servo", "servo", "goal", "start2"}, "other"), plain);
  EXPECT_EQ(angles({"body", "robot", "start", "current", "robot", "output", "torque"}, "robot"),
            plain);
}

// An argument that the Include or the base has means that; the joint of its name has another.
TEST(UrdfJoints, AnArgumentMeansOneThing) {
  const std::string one = inertial(1., "1 1 1");
  const auto text = [&](const std::string& name) {
    return "<robot name=\"r\">" + link("b", one) + link("l", one) + joint(name, "continuous", "") +
           "</robot>";
  };
  const Loaded turned = load_named("urdf", text("orientation"),
                                   "orientation = 0, 0, 90 deg, orientation_angle = 0.3 rad");
  ASSERT_TRUE(turned.experiment) << turned.diagnostics;
  EXPECT_NEAR(turned.experiment->robots.at(0).orientation.z, std::sqrt(0.5), 1e-15);
  EXPECT_EQ(turned.experiment->robots.at(0).chains.at(0).links.at(0).angle, 0.3);
  const Loaded held = load_named("urdf", text("hold"), "hold = 0.05");
  ASSERT_TRUE(held.experiment) << held.diagnostics;
  EXPECT_EQ(held.experiment->robots.at(0).chains.at(0).links.at(0).angle, 0.);
  EXPECT_NE(
      held.diagnostics.find(
          "`hold` is not joint `hold` here: the argument `hold_angle` says where that starts"),
      std::string::npos)
      << held.diagnostics;
  // Two joints that the language calls alike.
  const Loaded two = load_named("urdf",
                                "<robot name=\"r\">" + link("b", one) + link("l", one) +
                                    link("m", one) + joint("j 1", "continuous", "") +
                                    joint("j_1", "continuous", "", "l", "m") + "</robot>",
                                "j_1 = 0.3 rad");
  EXPECT_FALSE(two.experiment);
  EXPECT_NE(
      two.diagnostics.find("the argument `j_1` means where joint `j 1` starts, and where joint "
                           "`j_1` starts"),
      std::string::npos)
      << two.diagnostics;
}

simulation::MassSpec mass_of(const Loaded& loaded) {
  EXPECT_TRUE(loaded.experiment) << loaded.diagnostics;
  return loaded.experiment->robots.at(0).chains.at(0).links.at(0).body.mass;
}

std::string turning(double mass, const std::string& moments) {
  return robot(link("l", inertial(mass, moments)) +
               joint("j", "continuous", "<axis xyz=\"0 0 1\"/>"));
}

// c = a + b is a plane with the normal (1, 1, -1)/sqrt(3): (9, 1, 1) has the nearest point
// (9 - 7/3, 1 + 7/3, 1 + 7/3).
TEST(UrdfInertia, TheNearestThatABodyCanHave) {
  const Loaded loaded = load_urdf(turning(1., "9 1 1"), ", inertia = repair");
  const Symmetric3d I = mass_of(loaded).inertia;
  EXPECT_NEAR(I.xx, 20. / 3., 1e-12);
  EXPECT_NEAR(I.yy, 10. / 3., 1e-12);
  EXPECT_NEAR(I.zz, 10. / 3., 1e-12);
  EXPECT_NEAR(I.xy, 0., 1e-12);
  EXPECT_NE(loaded.diagnostics.find("inertias repaired: `l` (by 35 % of its greatest moment)"),
            std::string::npos)
      << loaded.diagnostics;
}

TEST(UrdfInertia, ANegativeMomentBecomesAThousandthOfTheGreatest) {
  const Symmetric3d I = mass_of(load_urdf(turning(1., "-1 2 2"), ", inertia = repair")).inertia;
  EXPECT_NEAR(I.xx, 2e-3, 1e-12);
  EXPECT_NEAR(I.yy, 2., 1e-12);
  EXPECT_NEAR(I.zz, 2., 1e-12);
}

// 2/5 m r^2 with 4/3 pi r^3 1000 kg/m^3 = m.
TEST(UrdfInertia, NoneAtAllBecomesThatOfABallOfWater) {
  const double r = std::cbrt(3. * 2. / (4. * M_PI * 1000.));
  const Symmetric3d I = mass_of(load_urdf(turning(2., "0 0 0"), ", inertia = repair")).inertia;
  EXPECT_NEAR(I.xx, 0.4 * 2. * r * r, 1e-15);
  EXPECT_EQ(I.xx, I.zz);
}

TEST(UrdfInertia, WhatIsPhysicalStays) {
  const Loaded loaded = load_urdf(turning(1., "1 2 2.5"), ", inertia = repair");
  EXPECT_EQ(loaded.diagnostics, "");
  EXPECT_EQ(mass_of(loaded).inertia, (Symmetric3d{1., 2., 2.5, 0., 0., 0.}));
}

TEST(UrdfInertia, ABaseWithoutMassGetsAThousandthOfTheRobots) {
  const std::string text = "<robot name=\"r\">\n<link name=\"b\"/>\n" +
                           link("l", inertial(3., "1 1 1")) +
                           joint("j", "continuous", "<axis xyz=\"0 0 1\"/>") + "</robot>";
  EXPECT_NE(load_urdf(text, ", base = mobile").diagnostics.find("inertia = repair gives it a"),
            std::string::npos);
  const Loaded loaded = load_urdf(text, ", base = mobile, inertia = repair");
  ASSERT_TRUE(loaded.experiment) << loaded.diagnostics;
  EXPECT_DOUBLE_EQ(loaded.experiment->robots.at(0).base.mass.mass, 3e-3);
}

TEST(UrdfInertia, AnInertiaWithoutMassIsLeftOut) {
  const std::string text =
      robot(link("l", inertial(1., "1 1 1")) + link("m", inertial(0., "1 1 1")) +
            joint("j", "continuous", "<axis xyz=\"0 0 1\"/>") + joint("k", "fixed", "", "l", "m"));
  const Loaded wrong = load_urdf(text);
  EXPECT_FALSE(wrong.experiment);
  EXPECT_NE(wrong.diagnostics.find("link `m` has an inertia and no mass"), std::string::npos)
      << wrong.diagnostics;
  EXPECT_EQ(mass_of(load_urdf(text, ", inertia = repair")).inertia,
            (Symmetric3d{1., 1., 1., 0., 0., 0.}));
}

}  // namespace
}  // namespace hookpoint
