// hookpoint export: a robot written as MJCF, URDF or SDF and read again has the same free accelerations.
#include <gtest/gtest.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <map>
#include <pugixml.hpp>
#include <random>
#include <sstream>

#include "dts/configuration.h"
#include "dts/forward_dynamics.h"
#include "simulation/dts_engine/robot_description.h"
#include "simulation/experiment/kinematics.h"
#include "simulation/experiment/robot_tree.h"
#include "tests/support/command.h"
#include "tests/support/folders.h"
#include "tests/support/load_text.h"
#include "tests/support/mjcf_robot.h"
#include "translation/models/model.h"
#include "translation/models/writing.h"

namespace hookpoint::tests {
namespace {

constexpr std::size_t first = 0;

std::string written(const translation::ModelFormat& format,
                    const simulation::Experiment& experiment) {
  return format.write(experiment, std::span(&first, 1), std::nullopt).text;
}

/// The Robot of a model file, in a World of its own.
Loaded read_again(const std::string& name, const std::string& text,
                  const std::string& arguments = "") {
  const testing::Workplace place;
  place.file(name, text);
  return load_file(place.file("scene.hook",
                              "World w { Include \"" + name + "\" (name = r" + arguments + "); }"));
}

/// The joints of `again` in the order of the robot that was written; ours without mass are BODY_JOINT there.
std::vector<std::size_t> joints_of(const simulation::Experiment& experiment,
                                   const simulation::RobotSpec& again) {
  const translation::ModelTree tree(experiment, std::span(&first, 1));
  std::vector<std::string> names;
  simulation::for_each_link(
      again, [&](const simulation::TreeLink& at) { names.push_back(at.link.body.name); });
  std::vector<std::size_t> order;
  for (std::size_t body = 1; body < tree.size(); ++body) {
    const auto found = std::ranges::find_if(names, [&](const std::string& name) {
      return name == tree.name(body) || name.ends_with("_" + tree.name(body));
    });
    EXPECT_NE(found, names.end()) << tree.name(body);
    order.push_back(static_cast<std::size_t>(found - names.begin()));
  }
  return order;
}

/// Largest difference of free accelerations in random states, relative to the largest.
double worst(const simulation::RobotSpec& a, const simulation::RobotSpec& b,
             const std::vector<std::size_t>& b_of_a, unsigned seed) {
  const dts::Model<double> first_model(simulation::describe_robot(a)),
      second_model(simulation::describe_robot(b));
  dts::Workspace<double> first_work(first_model), second_work(second_model);
  std::mt19937 random(seed);
  const auto uniform = [&] { return double(random()) / double(std::mt19937::max()) * 2. - 1.; };
  const std::size_t joints = b_of_a.size();
  double difference = 0.;
  for (int round = 0; round < 3; ++round) {
    dts::State<double> state = dts::zero_state(first_model);
    if (a.mobile) {
      state.base_position = {uniform(), uniform(), uniform()};
      state.base_orientation = normalized(Quaterniond{uniform(), uniform(), uniform(), uniform()});
      state.base_velocity = {uniform(), uniform(), uniform()};
      state.base_angular_velocity = {uniform(), uniform(), uniform()};
    }
    dts::State<double> other = state;
    std::vector<double> torques(joints), others(joints);
    for (std::size_t i = 0; i < joints; ++i) {
      other.joint_positions[b_of_a[i]] = state.joint_positions[i] = uniform();
      other.joint_rates[b_of_a[i]] = state.joint_rates[i] = uniform();
      others[b_of_a[i]] = torques[i] = uniform();
    }
    const Vector3d gravity{1.5, -2., 9.};
    dts::forward_dynamics(first_model, state, gravity, torques, first_work);
    dts::forward_dynamics(second_model, other, gravity, others, second_work);
    std::vector<double> x(dts::velocity_count(first_model)), y(dts::velocity_count(second_model));
    EXPECT_EQ(x.size(), y.size());
    dts::get_acceleration(first_model, first_work, std::span<double>(x));
    dts::get_acceleration(second_model, second_work, std::span<double>(y));
    const std::size_t base = x.size() - joints;
    double size = 1.;
    for (const double value : x) size = std::max(size, std::abs(value));
    for (std::size_t i = 0; i < x.size(); ++i) {
      const std::size_t k = i < base ? i : base + b_of_a[i - base];
      difference = std::max(difference, std::abs(x[i] - y[k]) / size);
    }
  }
  return difference;
}

void expect_round_trips(const simulation::Experiment& experiment, unsigned seed) {
  const simulation::RobotSpec& robot = experiment.robots[0];
  const std::string base = robot.mobile ? "" : ", base = fixed";
  for (const auto& [format, name, arguments] :
       {std::tuple{&translation::mjcf_format, "robot.xml", std::string()},
        std::tuple{&translation::urdf_format, "robot.urdf", base}}) {
    const std::string text = written(*format, experiment);
    const Loaded again = read_again(name, text, arguments);
    ASSERT_TRUE(again.experiment) << again.diagnostics << text;
    const simulation::RobotSpec& other = again.experiment->robots[0];
    EXPECT_EQ(other.mobile, robot.mobile);
    EXPECT_NEAR(simulation::moving_mass(other), simulation::moving_mass(robot), 1e-12);
    EXPECT_LE(worst(robot, other, joints_of(experiment, other), seed), 1e-12) << text;
  }
}

// Trees with joints of both kinds, several on a body (links without mass), frames of any orientation, rotors.
TEST(Export, DrawnRobotsComeBack) {
  RandomMjcf random(5);
  for (int i = 0; i < 40; ++i) {
    const std::string text = random.robot(2 + i % 8);
    const Loaded loaded = read_again("robot.xml", text);
    ASSERT_TRUE(loaded.experiment) << loaded.diagnostics;
    expect_round_trips(*loaded.experiment, unsigned(i));
  }
}

TEST(Export, RobotsOfTheScenesComeBack) {
  int judged = 0;
  for (const char* scene : {"standing_hexapod", "walking_hexapod", "standing_quadruped_urdf",
                            "sloped_block", "climbing_hound"}) {
    const std::string file = testing::source_folder() + "/configs/scenes/" + scene + ".hook";
    if (!std::filesystem::exists(file)) continue;
    const Loaded loaded = load_file(file);
    ASSERT_TRUE(loaded.experiment) << loaded.diagnostics;
    SCOPED_TRACE(scene);
    expect_round_trips(*loaded.experiment, 3);
    ++judged;
  }
  EXPECT_GE(judged, 4);
}

// SDF has neither rotors nor links without mass.
TEST(Export, DrawnRobotsComeBackFromSdf) {
  RandomMjcf random(8);
  int judged = 0;
  for (int i = 0; i < 60; ++i) {
    const Loaded loaded = read_again("robot.xml", random.robot(2 + i % 8));
    ASSERT_TRUE(loaded.experiment) << loaded.diagnostics;
    simulation::Experiment experiment = *loaded.experiment;
    bool all_heavy = true;
    for (simulation::ChainSpec& chain : experiment.robots[0].chains) {
      for (simulation::LinkSpec& link : chain.links) {
        link.rotor_inertia = 0.;
        all_heavy = all_heavy && link.body.mass.mass > 0.;
      }
    }
    if (!all_heavy) continue;
    ++judged;
    const std::string text = written(translation::sdf_format, experiment);
    const Loaded again = read_again("robot.sdf", text);
    ASSERT_TRUE(again.experiment) << again.diagnostics << text;
    const simulation::RobotSpec &robot = experiment.robots[0], &other = again.experiment->robots[0];
    EXPECT_NEAR(simulation::moving_mass(other), simulation::moving_mass(robot), 1e-12);
    EXPECT_LE(worst(robot, other, joints_of(experiment, other), unsigned(i)), 1e-12) << text;
  }
  EXPECT_GE(judged, 10);
}

// What a joint has, and the state at the start as a keyframe.
TEST(Export, JointsAndTheStartAreTheSame) {
  const Loaded loaded = load_text(
      "World w { Robot r { Base.mobile { location = 1, 2, 3; orientation = 0.1, 0.2, 0.3; velocity = 0.1, 0.2, 0.3;\n"
      "angular_velocity = 1, 2, 3; mass = 2; inertia = 1, 1, 1, 0, 0, 0; Shape.Box { dimensions = 1, 1, 1; } }\n"
      "Chain leg { hip_distance = 0.1, 0.2, 0.3; Link thigh { dhlength = 0.2; dhtwist = 1.2; mass = 1; inertia = 1, 1, "
      "1, 0, 0, 0;\nangle = 0.4; rate = 0.5; damping = 0.6; friction = 0.7; stiffness = 8; rest_angle = 0.9; lower_limit "
      "= -1; upper_limit = 1.1; effort_limit = 12; rotor_inertia = 0.13; } } } }");
  ASSERT_TRUE(loaded.experiment) << loaded.diagnostics;
  const Loaded again = read_again(
      "robot.xml", written(translation::mjcf_format, *loaded.experiment), ", keyframe = home");
  ASSERT_TRUE(again.experiment) << again.diagnostics;
  const simulation::RobotSpec &a = loaded.experiment->robots[0], &b = again.experiment->robots[0];
  EXPECT_LE(norm(a.location - b.location), 1e-15);
  EXPECT_LE(norm(a.velocity - b.velocity), 1e-15);
  EXPECT_LE(norm(a.angular_velocity - b.angular_velocity), 1e-14);
  const simulation::LinkSpec &one = a.chains[0].links[0], &two = b.chains[0].links[0];
  for (double simulation::LinkSpec::*field :
       {&simulation::LinkSpec::angle, &simulation::LinkSpec::rate, &simulation::LinkSpec::damping,
        &simulation::LinkSpec::friction, &simulation::LinkSpec::stiffness,
        &simulation::LinkSpec::rest_angle, &simulation::LinkSpec::rotor_inertia})
    EXPECT_EQ(one.*field, two.*field);
  EXPECT_EQ(one.lower_limit, two.lower_limit);
  EXPECT_EQ(one.upper_limit, two.upper_limit);
  EXPECT_EQ(one.effort_limit, two.effort_limit);
  ASSERT_EQ(b.base.shapes.size(), 1u);
  EXPECT_LE(
      norm(std::get<simulation::Box>(b.base.shapes[0].geometry).dimensions - Vector3d{1., 1., 1.}),
      1e-15);
}

/// A Link of its own Chain, with these fields.
std::string one_link(const std::string& name, const std::string& fields) {
  return "Chain to_" + name + " { Link " + name + " { mass = 1; inertia = 1, 1, 1, 0, 0, 0; " +
         fields + " } }\n";
}

// urdfdom refuses a revolute or prismatic joint without <limit>, and a <limit> without effort or velocity;
// a stop that is not written is 0 there.
TEST(Export, EveryLimitOfAUrdfIsWritten) {
  std::string links;
  int count = 0;
  for (const char* kind : {"", "joint = prismatic; "}) {
    for (const char* stops :
         {"", "lower_limit = -1; ", "upper_limit = 2; ", "lower_limit = -1; upper_limit = 2; "}) {
      for (const char* drive : {"", "effort_limit = 3; ", "velocity_limit = 4; ",
                                "effort_limit = 3; velocity_limit = 4; "})
        links += one_link("l" + std::to_string(++count), std::string(kind) + stops + drive);
    }
  }
  const Loaded loaded =
      load_text("World w { Robot r { Base.mobile { mass = 2; inertia = 1, 1, 1, 0, 0, 0; }\n" +
                links + "} }");
  ASSERT_TRUE(loaded.experiment) << loaded.diagnostics;
  const std::string text = written(translation::urdf_format, *loaded.experiment);
  pugi::xml_document document;
  ASSERT_TRUE(document.load_string(text.c_str()));
  int judged = 0;
  for (const pugi::xml_node& joint : document.child("robot").children("joint")) {
    const std::string type = joint.attribute("type").value();
    const pugi::xml_node limit = joint.child("limit");
    EXPECT_TRUE(limit || type == "continuous") << text;
    for (const char* name : {"lower", "upper"})
      EXPECT_EQ(bool(limit.attribute(name)), type != "continuous") << text;
    for (const char* name : {"effort", "velocity"})
      EXPECT_EQ(bool(limit.attribute(name)), bool(limit)) << text;
    ++judged;
  }
  EXPECT_EQ(judged, count);
  const Loaded again = read_again("robot.urdf", text);
  ASSERT_TRUE(again.experiment) << again.diagnostics;
  const auto& ours = loaded.experiment->robots[0].chains;
  const auto& theirs = again.experiment->robots[0].chains;
  ASSERT_EQ(theirs.size(), ours.size());
  for (std::size_t i = 0; i < ours.size(); ++i) {
    const simulation::LinkSpec &a = ours[i].links[0], &b = theirs[i].links[0];
    EXPECT_EQ(b.body.name, a.body.name);
    EXPECT_EQ(b.lower_limit, a.lower_limit);
    EXPECT_EQ(b.upper_limit, a.upper_limit);
    EXPECT_EQ(b.effort_limit, a.effort_limit);
    EXPECT_EQ(b.velocity_limit, a.velocity_limit);
  }
}

// Frames put together as SDFormat says, each in the one that it names, without our reader.
TEST(Export, LinksOfAnSdfStandWhereOursDo) {
  RandomMjcf random(8);
  for (int i = 0; i < 20; ++i) {
    const Loaded loaded = read_again("robot.xml", random.robot(2 + i % 8));
    ASSERT_TRUE(loaded.experiment) << loaded.diagnostics;
    const simulation::Experiment& experiment = *loaded.experiment;
    pugi::xml_document document;
    ASSERT_TRUE(document.load_string(written(translation::sdf_format, experiment).c_str()));
    const pugi::xml_node model = document.child("sdf").child("world").child("model");
    std::map<std::string, simulation::Pose> placed;
    simulation::RobotSpec robot = experiment.robots[0];
    for (simulation::ChainSpec& chain : robot.chains)
      for (simulation::LinkSpec& link : chain.links) link.angle = 0.;
    const std::vector<simulation::Pose> ours = simulation::body_poses(robot);
    const translation::ModelTree tree(experiment, std::span(&first, 1));
    const auto pose_of = [](const pugi::xml_node& node) {
      std::istringstream text(node.child("pose").text().get());
      std::array<double, 6> n{};
      for (double& number : n) text >> number;
      return simulation::Pose{{n[0], n[1], n[2]}, from_roll_pitch_yaw(n[3], n[4], n[5])};
    };
    std::size_t count = 0;
    for (const pugi::xml_node& link : model.children("link")) {
      const std::string name = link.attribute("name").value();
      const std::string parent = link.child("pose").attribute("relative_to").value();
      placed[name] = parent.empty() ? pose_of(link) : placed.at(parent) * pose_of(link);
      ++count;
    }
    EXPECT_EQ(count, tree.size());
    for (std::size_t body = 0; body < tree.size(); ++body) {
      const simulation::Pose& there = placed.at(tree.name(body));
      EXPECT_LE(norm(there.position - ours[body].position), 1e-12);
      const Vector3d z{0.3, -0.4, 1.};
      EXPECT_LE(norm(rotate(there.orientation, z) - rotate(ours[body].orientation, z)), 1e-12);
    }
    double mass = 0.;
    for (const pugi::xml_node& link : model.children("link"))
      mass += link.child("inertial").child("mass").text().as_double();
    // SDF has no link without mass: those are 1 mg.
    double added = 0.;
    simulation::for_each_link(robot, [&](const simulation::TreeLink& at) {
      if (at.link.body.mass.mass == 0.) added += 1e-6;
    });
    EXPECT_NEAR(mass, simulation::robot_mass(robot) + added, 1e-12);
    EXPECT_EQ(std::distance(model.children("joint").begin(), model.children("joint").end()),
              static_cast<std::ptrdiff_t>(simulation::joint_count(robot)));
  }
}

// rpy as URDF and SDF have it, also where x points up or down.
TEST(Export, RollPitchYawIsTheRotation) {
  std::mt19937 random(2);
  const auto uniform = [&] { return double(random()) / double(std::mt19937::max()) * 2. - 1.; };
  for (int i = 0; i < 2000; ++i) {
    Quaterniond q = normalized(Quaterniond{uniform(), uniform(), uniform(), uniform()});
    if (i % 4 == 0) {
      const double lean = std::pow(10., -16. * std::abs(uniform()));
      q = from_roll_pitch_yaw(3. * uniform(), (i % 8 == 0 ? 1. : -1.) * (std::acos(0.) - lean),
                              3. * uniform());
    }
    const Vector3d rpy = translation::roll_pitch_yaw(q);
    const Matrix3d a = rotation_matrix(q),
                   b = rotation_matrix(from_roll_pitch_yaw(rpy.x, rpy.y, rpy.z));
    for (double Matrix3d::*part :
         {&Matrix3d::xx, &Matrix3d::xy, &Matrix3d::xz, &Matrix3d::yx, &Matrix3d::yy, &Matrix3d::yz,
          &Matrix3d::zx, &Matrix3d::zy, &Matrix3d::zz})
      EXPECT_NEAR(a.*part, b.*part, 2e-12);
  }
}

}  // namespace
}  // namespace hookpoint::tests
