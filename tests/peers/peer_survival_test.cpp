// Scenes that a library was not made for: a run is refused or stops with words, and the process
// goes on. Robots without anything that moves run.
#include <gtest/gtest.h>

#include <cmath>
#include <functional>
#include <string>

#include "reference/engines.h"
#include "tests/support/reference_scenes.h"

namespace hookpoint {
namespace {

using namespace reference_scenes;

bool finite(const simulation::WorldState& state) {
  for (const simulation::BodyState& body : state.bodies)
    if (!std::isfinite(norm(1e-200 * body.position)) ||
        !std::isfinite(norm(1e-200 * body.velocity)))
      return false;
  return true;
}

/// What the peer says of ten steps: the refusal, the failure, or nothing where they succeed. What
/// it publishes is finite all the while.
std::string words(const reference::Peer& peer, const simulation::Experiment& experiment) {
  try {
    const auto engine = peer.make(experiment);
    for (int i = 0; i < 10; ++i) {
      const auto status = engine->step();
      EXPECT_TRUE(finite(engine->state())) << peer.name;
      if (!status.ok()) return status.body + ": " + status.advice;
    }
  } catch (const simulation::ExperimentError& error) {
    return error.what();
  }
  return "";
}

simulation::RobotSpec post() {
  simulation::RobotSpec robot;
  robot.name = "post";
  robot.base.name = "base";
  robot.location = {0., 0., 0.3};
  return robot;
}

TEST(FixedBaseAlone, RunsInEveryPeer) {
  for (const auto& peer : reference::peers())
    for (const bool ground : {false, true})
      for (const bool shape : {false, true})
        for (const bool beside : {false, true}) {
          simulation::Experiment experiment = sloped_block(0.1, 0., 0.5, 1e-3);
          if (!beside) experiment.robots.clear();
          if (!ground) experiment.terrain.reset();
          experiment.robots.push_back(post());
          if (shape) experiment.robots.back().base.shapes = block().base.shapes;
          simulation::ForceSpec force;
          force.robot = static_cast<int>(experiment.robots.size()) - 1;
          force.force = {1., 2., 3.};
          experiment.forces.push_back(force);
          EXPECT_EQ(words(peer, experiment), "") << peer.name;
        }
}

/// A block over the ground with a sphere on a joint.
simulation::Experiment with_link(simulation::JointKind joint) {
  simulation::Experiment experiment = sloped_block(0., 0., 0.5, 1e-3);
  simulation::LinkSpec& link = experiment.robots[0].chains.emplace_back().links.emplace_back();
  experiment.robots[0].chains[0].name = "leg";
  link.body.name = "shin";
  link.joint = joint;
  link.body.mass = {0.3, {0.1, 0., 0.}, {1e-3, 1e-3, 1e-3, 0., 0., 0.}};
  link.body.boundary_points = {{0., 0., 0.}};
  for (const double x : {-0.1, 0.1})
    for (const double y : {-0.1, 0.1})
      experiment.robots[0].base.boundary_points.push_back({x, y, -0.05});
  return experiment;
}

TEST(DegenerateScene, EndsARunAtMost) {
  using enum simulation::JointKind;
  using Change = std::function<void(simulation::RobotSpec&)>;
  const auto link = [](simulation::RobotSpec& robot) -> simulation::LinkSpec& {
    return robot.chains[0].links[0];
  };
  const std::vector<Change> changes{
      [&](auto& robot) {
        robot.chains[0].hip_distance = {-1e57, -0.05, 0.};
      },
      [&](auto& robot) {
        robot.chains[0].hip_distance = {-1e12, -0.05, 0.};
      },
      [&](auto& robot) { link(robot).body.mass.inertia = {}; },
      [&](auto& robot) {
        link(robot).body.mass = {5e-324, {}, {5e-324, 5e-324, 5e-324, 0., 0., 0.}};
      },
      [&](auto& robot) {
        link(robot).body.mass = {1e300, {}, {1e300, 1e300, 1e300, 0., 0., 0.}};
      },
      [&](auto& robot) { link(robot).body.mass.inertia = {1e-3, 1e-3, 1., 0.5, 0., 0.}; },
      [&](auto& robot) {
        link(robot).body.mass.center_of_mass = {1e40, 0., 0.};
      },
      [&](auto& robot) { link(robot).rate = 1e27; },
      [&](auto& robot) { link(robot).angle = 1e40; },
      [&](auto& robot) { robot.base.mass.mass = 1e-300; },
      [&](auto& robot) {
        robot.location = {1e40, 0., -1e40};
      },
      [&](auto& robot) {
        robot.velocity = {1e40, 0., -1e40};
      },
      [&](auto& robot) {
        robot.angular_velocity = {1e30, 0., 1e30};
      },
  };
  for (const auto& peer : reference::peers())
    for (std::size_t i = 0; i < changes.size(); ++i)
      for (const auto joint : {revolute, prismatic}) {
        simulation::Experiment experiment = with_link(joint);
        changes[i](experiment.robots[0]);
        const std::string said = words(peer, experiment);
        // Simbody's that end at its bound on steps are long; one of them is below.
        if (peer.name == "simbody") continue;
        EXPECT_EQ(said, words(peer, experiment)) << peer.name << " " << i;
      }
}

// Its assertions call abort(): with a hip as far away as that a matrix of its is not symmetric.
TEST(Dart, EndsTheRunWhereAnAssertionOfItsFails) {
  simulation::Experiment experiment = with_link(simulation::JointKind::prismatic);
  experiment.touch = "points";  // of which it has none
  experiment.robots[0].chains[0].hip_distance = {-1e57, -0.05, 0.};
  experiment.robots[0].location = {};
  const auto good = sloped_block(0.1, 0., 0.5, 1e-3);
  for (const auto& peer : reference::peers())
    if (peer.name == "dart") {
      ::testing::internal::CaptureStderr();
      EXPECT_NE(words(peer, experiment).find("assertion"), std::string::npos);
      EXPECT_NE(::testing::internal::GetCapturedStderr().find("Assertion"), std::string::npos);
      EXPECT_EQ(words(peer, good), "");
    }
}

// A link that turns 1e9 times faster than a foot, with friction full at 1 mm/s: some 1e7 steps of
// its own a millisecond.
TEST(Simbody, GivesUpAStepThatItsIntegratorWouldNotEnd) {
  simulation::Experiment experiment = with_link(simulation::JointKind::revolute);
  experiment.settings = "recommended";
  experiment.robots[0].chains[0].links[0].rate = 1e9;
  for (const auto& peer : reference::peers())
    if (peer.name == "simbody") {
      const std::string said = words(peer, experiment);
      EXPECT_NE(said.find("steps of its own"), std::string::npos);
      EXPECT_EQ(said, words(peer, experiment));
    }
}

TEST(Ode, NamesTheLinkThatHasNoInertia) {
  simulation::Experiment experiment = with_link(simulation::JointKind::revolute);
  experiment.robots[0].chains[0].links[0].body.mass.inertia = {};
  for (const auto& peer : reference::peers())
    if (peer.name == "ode" || peer.name == "ode_quickstep") {
      EXPECT_NE(words(peer, experiment).find("link leg.shin of robot 'block'"), std::string::npos);
    }
}

}  // namespace
}  // namespace hookpoint
