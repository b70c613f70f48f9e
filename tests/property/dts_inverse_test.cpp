// Inverse dynamics undoes forward dynamics, and obeys Newton and Euler for the robot as a whole.
#include <gtest/gtest.h>

#include "dts/external_forces.h"
#include "dts/forward_dynamics.h"
#include "dts/inverse_dynamics.h"
#include "tests/support/random_robot.h"

namespace hookpoint::tests {
namespace {

struct Drawn {
  dts::RobotDescription robot;
  dts::Model<double> model;
  dts::State<double> state;
  dts::Workspace<double> workspace;
  Vector3d gravity;

  Drawn(RandomRobots& random, bool mobile, int chains, bool degenerate, bool branching)
      : robot(branching ? random.tree(mobile, chains, degenerate)
                        : random.robot(mobile, chains, degenerate)),
        model(robot),
        state(random.state(model)),
        workspace(model),
        gravity(random.vector(10.)) {
    dts::forward_kinematics(model, state, workspace);
    for (std::size_t body = 1; body < model.body_count(); ++body) {
      dts::add_external_force(workspace, body, random.vector(5.), random.vector(2.));
    }
  }
};

TEST(DtsInverse, ForwardOfInverseIsTheIdentity) {
  RandomRobots random(21);
  for (int repetition = 0; repetition < 120; ++repetition) {
    Drawn x(random, repetition % 2 == 0, repetition % 7, repetition % 3 == 0, repetition >= 60);
    const std::size_t n = x.model.link_count();
    const std::vector<double> wanted = random.numbers(n, 5.);
    dts::Accelerations<double> accelerations{{}, {}, wanted};
    if (x.robot.mobile) {
      accelerations.base_angular = random.vector(5.);
      accelerations.base_linear = random.vector(5.);
    }
    std::vector<double> torques(n);
    const dts::Wrench<double> support = dts::inverse_dynamics(
        x.model, x.gravity, accelerations, std::span<double>(torques), x.workspace);
    dts::add_external_force(x.workspace, 0, support.force, x.state.base_position);
    dts::add_external_torque(x.workspace, 0, support.moment);
    dts::forward_dynamics(x.model, x.gravity, torques, x.workspace);
    for (std::size_t l = 0; l < n; ++l) {
      EXPECT_NEAR(x.workspace.joint_accelerations[l], wanted[l], 1e-8);
    }
    EXPECT_NEAR(norm(x.workspace.base_acceleration - accelerations.base_linear), 0., 1e-8);
    EXPECT_NEAR(norm(x.workspace.base_angular_acceleration - accelerations.base_angular), 0., 1e-8);
  }
}

TEST(DtsInverse, InverseOfForwardIsTheIdentityAndFreeMotionNeedsNoSupport) {
  RandomRobots random(22);
  for (int repetition = 0; repetition < 60; ++repetition) {
    Drawn x(random, true, 1 + repetition % 6, repetition % 3 == 0, repetition >= 30);
    const std::vector<double> torques = random.numbers(x.model.link_count(), 5.);
    dts::forward_dynamics(x.model, x.gravity, torques, x.workspace);
    const std::vector<double> found = x.workspace.joint_accelerations;
    std::vector<double> returned(torques.size());
    const dts::Wrench<double> support = dts::inverse_dynamics(
        x.model, x.gravity,
        {x.workspace.base_angular_acceleration, x.workspace.base_acceleration, found},
        std::span<double>(returned), x.workspace);
    for (std::size_t l = 0; l < torques.size(); ++l) EXPECT_NEAR(returned[l], torques[l], 1e-8);
    EXPECT_NEAR(norm(support.force), 0., 1e-8);
    EXPECT_NEAR(norm(support.moment), 0., 1e-8);
  }
}

TEST(DtsInverse, AtRestTheSupportCarriesTheWeight) {
  RandomRobots random(23);
  const dts::RobotDescription robot = random.tree(true, 4, false);
  const dts::Model<double> model(robot);
  dts::Workspace<double> workspace(model);
  dts::State<double> state = random.state(model);
  state.base_velocity = state.base_angular_velocity = {};
  state.joint_rates.assign(model.link_count(), 0.);
  dts::forward_kinematics(model, state, workspace);
  const std::vector<double> rest(model.link_count());
  std::vector<double> torques(model.link_count());
  const Vector3d gravity{0., 0., -9.81};
  const dts::Wrench<double> support =
      dts::inverse_dynamics(model, gravity, {{}, {}, rest}, std::span<double>(torques), workspace);
  double weight = 9.81 * robot.base.mass;
  for (const auto& chain : robot.chains) {
    for (const auto& link : chain.links) weight += 9.81 * link.mass.mass;
  }
  EXPECT_NEAR(norm(support.force - Vector3d{0., 0., weight}), 0., 1e-11);
}

}  // namespace
}  // namespace hookpoint::tests
