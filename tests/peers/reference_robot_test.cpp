// Robots with chains under the peers, without ground: the same places, accelerations and joint laws
// as ours, conserved momentum, and the traps of each library.
#include <gtest/gtest.h>

#include "dts/joint_forces.h"
#include "reference/engines.h"
#include "reference/robot_tree.h"
#include "simulation/dts_engine.h"
#include "tests/support/reference_robots.h"

namespace hookpoint {
namespace {

using namespace reference_scenes;
using simulation::BodyState;

double distance(const Vector3d& a, const Vector3d& b) { return norm(a - b); }

TEST(RobotTree, PlacesAndMovesEveryBodyAsOurEngineDoes) {
  for (const bool mobile : {true, false}) {
    simulation::RobotSpec robot = skew_robot(3, 4, mobile);
    set_in_motion(robot);
    const simulation::Experiment experiment = robot_world(robot, 1e-3);
    const auto ours = simulation::make_dts(experiment);
    const reference::RobotTree tree = reference::robot_tree(experiment);
    ASSERT_EQ(tree.bodies.size(), ours->state().bodies.size());
    EXPECT_EQ(tree.joints, ours->state().joints.size());
    for (std::size_t i = 0; i < tree.bodies.size(); ++i) {
      const BodyState& a = tree.bodies[i].initial;
      const BodyState& b = ours->state().bodies[i];
      EXPECT_LT(distance(a.position, b.position), 1e-14) << i;
      EXPECT_LT(distance(a.velocity, b.velocity), 1e-14) << i;
      EXPECT_LT(distance(a.angular_velocity, b.angular_velocity), 1e-14) << i;
      const Vector3d x{0.3, 0.5, 0.7};
      EXPECT_LT(distance(rotate(a.orientation, x), rotate(b.orientation, x)), 1e-14) << i;
    }
  }
}

TEST(RobotTree, HasTheJointsOfOurEngine) {
  std::mt19937 random(3);
  std::uniform_real_distribution<double> unit(-1., 1.);
  for (int i = 0; i < 2000; ++i) {
    simulation::LinkSpec link;
    link.damping = 0.1;
    link.friction = 0.3;
    link.stiffness = 20.;
    link.rest_angle = 0.2;
    if (i % 3 != 0) link.lower_limit = -0.4;
    if (i % 2 != 0) link.upper_limit = 0.5;
    const double angle = unit(random), rate = 0.2 * unit(random);
    dts::JointProperties<double> joint;
    joint.damping = link.damping;
    joint.friction = link.friction;
    joint.stiffness = link.stiffness;
    joint.rest_position = link.rest_angle;
    if (link.lower_limit) joint.lower_limit = *link.lower_limit;
    if (link.upper_limit) joint.upper_limit = *link.upper_limit;
    EXPECT_NEAR(reference::joint_passive_force(link, angle, rate),
                dts::passive_joint_torque(joint, angle, rate), 1e-11);
  }
}

/// Largest relative difference of accelerations in the first step: of every joint, and of the base.
double acceleration_error(simulation::EngineFactory make,
                          const simulation::Experiment& experiment) {
  const auto ours = simulation::make_dts(experiment), theirs = make(experiment);
  const BodyState before = ours->state().bodies[0];
  EXPECT_TRUE(ours->step().ok() && theirs->step().ok());
  double largest = 0., error = 0.;
  for (std::size_t i = 0; i < ours->state().joints.size(); ++i) {
    const double expected = ours->state().joints[i].acceleration;
    largest = std::max(largest, std::abs(expected));
    error = std::max(error, std::abs(theirs->state().joints[i].acceleration - expected));
  }
  const BodyState& a = ours->state().bodies[0];
  const BodyState& b = theirs->state().bodies[0];
  const double per_second = 1. / experiment.deltat;
  largest = std::max(largest, per_second * norm(a.angular_velocity - before.angular_velocity));
  error = std::max(error, per_second * distance(a.angular_velocity, b.angular_velocity));
  error = std::max(error, per_second * distance(a.velocity, b.velocity));
  return error / largest;
}

// From rest the first step of every engine is dt times the accelerations, whatever dt: mass matrix,
// gravity and torques. ODE's joints have CFM 1e-10/dt beside inverse inertias of some 1000, so its
// dt is 1 s.
TEST(PeerRobot, AcceleratesFromRestAsOurs) {
  for (const auto& peer : reference::peers()) {
    if (peer.name == "ode_quickstep") continue;
    for (const bool mobile : {true, false}) {
      const auto experiment = robot_world(skew_robot(3, 4, mobile), 1.);
      const double error = acceleration_error(peer.make, experiment);
      std::printf("%s rest %g\n", std::string(peer.name).c_str(), error);
      EXPECT_LT(error, 1e-8) << peer.name << (mobile ? "" : ", fixed base");
    }
  }
}

TEST(PeerRobot, AcceleratesInMotionAsOurs) {
  for (const auto& peer : reference::peers()) {
    for (const bool mobile : {true, false})
      for (double dt : {1e-2, 1e-3, 1e-4, 1e-5}) {
        simulation::RobotSpec robot = skew_robot(3, 4, mobile);
        set_in_motion(robot);
        const double error = acceleration_error(peer.make, robot_world(robot, dt));
        std::printf("%s motion %d %g %g\n", std::string(peer.name).c_str(), mobile, dt, error);
      }
  }
}

}  // namespace
}  // namespace hookpoint
