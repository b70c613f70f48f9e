// Chains of a kind share the lanes of a pack: what a chain does must not depend on its lane or on
// its neighbours.
#include <gtest/gtest.h>

#include <algorithm>

#include "dts/external_forces.h"
#include "dts/forward_dynamics.h"
#include "dts/impulse_response.h"
#include "tests/support/random_robot.h"

namespace hookpoint::tests {
namespace {

/// `count` chains of the same joints, otherwise unlike.
dts::RobotDescription chains_of_a_kind(RandomRobots& random, bool mobile, int count,
                                       std::vector<dts::JointType> joints) {
  dts::RobotDescription robot = random.robot(mobile, 0, false);
  for (int k = 0; k < count; ++k) {
    dts::ChainDescription chain{random.vector(0.5), random.orientation(), {}};
    for (const dts::JointType joint : joints) {
      chain.links.push_back(random.link(k % 2 == 0, 0.));
      dts::LinkDescription& link = chain.links.back();
      link.joint = joint;
      // The second joint of each has a rotor, the others none.
      link.rotor_inertia = chain.links.size() == 2 ? 0.1 + link.rotor_inertia : 0.;
    }
    robot.chains.push_back(chain);
  }
  return robot;
}

const std::vector<dts::JointType> arm{dts::JointType::revolute, dts::JointType::prismatic,
                                      dts::JointType::revolute};

/// In one drawn state.
void expect_like_the_mass_matrix(RandomRobots& random, const dts::RobotDescription& robot,
                                 const dts::Model<double>& model) {
  const dts::State<double> state = random.state(model);
  const std::vector<double> torques = random.numbers(model.link_count(), 5.);
  const Vector3d gravity = random.vector(10.);
  dts::Workspace<double> workspace(model);
  dts::forward_dynamics(model, state, gravity, torques, workspace);
  std::vector<double> found(dts::velocity_count(model));
  dts::get_acceleration(model, workspace, std::span<double>(found));
  const Eigen::VectorXd truth =
      DenseDynamics(robot, state).accelerations(eigen(gravity), torques, {});
  const Eigen::Map<const Eigen::VectorXd> a(found.data(), Eigen::Index(found.size()));
  EXPECT_LE((a - truth).lpNorm<Eigen::Infinity>(), 1e-10 * truth.lpNorm<Eigen::Infinity>())
      << robot.chains.size() << " chains";
}

TEST(DtsLanes, AcceleratesLikeTheMassMatrixWhateverTheNumberOfLanesInUse) {
  RandomRobots random(41);
  for (int count = 1; count <= 9; ++count) {
    for (const bool mobile : {false, true}) {
      const dts::RobotDescription robot = chains_of_a_kind(random, mobile, count, arm);
      const dts::Model<double> model(robot);
      EXPECT_EQ(model.groups().size(), std::size_t(count + 3) / 4);
      expect_like_the_mass_matrix(random, robot, model);
    }
  }
}

/// Chain k's share of numbers kept one a link, for chains of arm's length.
std::vector<double> share(const std::vector<double>& of_links, std::size_t k) {
  const auto first = of_links.begin() + std::ptrdiff_t(k * arm.size());
  return {first, first + std::ptrdiff_t(arm.size())};
}

TEST(DtsLanes, AChainOnAFixedBaseMovesTheSameBitForBitInAnyLane) {
  RandomRobots random(42);
  dts::RobotDescription robot = chains_of_a_kind(random, false, 7, arm);
  const dts::Model<double> model(robot);
  dts::State<double> state = random.state(model);
  std::vector<double> torques = random.numbers(model.link_count(), 5.);
  const Vector3d gravity = random.vector(10.);
  dts::Workspace<double> workspace(model);
  dts::forward_dynamics(model, state, gravity, torques, workspace);

  // The first chain goes last, so that every chain changes its lane.
  dts::RobotDescription other = robot;
  std::ranges::rotate(other.chains, other.chains.begin() + 1);
  const auto rotate_links = [](std::vector<double>& of_links) {
    std::ranges::rotate(of_links, of_links.begin() + std::ptrdiff_t(arm.size()));
  };
  rotate_links(state.joint_positions);
  rotate_links(state.joint_rates);
  rotate_links(torques);
  const dts::Model<double> other_model(other);
  dts::Workspace<double> other_workspace(other_model);
  dts::forward_dynamics(other_model, state, gravity, torques, other_workspace);
  for (std::size_t k = 0; k < 7; ++k) {
    const std::size_t moved = (k + 6) % 7;
    EXPECT_EQ(share(workspace.joint_accelerations, k),
              share(other_workspace.joint_accelerations, moved))
        << k;
    EXPECT_EQ(workspace.hip_wrenches[k].force, other_workspace.hip_wrenches[moved].force) << k;
    EXPECT_EQ(workspace.hip_wrenches[k].moment, other_workspace.hip_wrenches[moved].moment) << k;
  }
}

// Elimination with a rotor rounds otherwise than without.
TEST(DtsLanes, AChainWithARotorElsewhereIsOfAnotherKind) {
  RandomRobots random(46);
  dts::RobotDescription robot = chains_of_a_kind(random, false, 3, arm);
  robot.chains[1].links[0].rotor_inertia = 0.2;
  const dts::Model<double> model(robot);
  EXPECT_EQ(model.groups().size(), 2U);
  expect_like_the_mass_matrix(random, robot, model);
}

/// `count` chains of a kind, each on a link of its own of as many others.
dts::RobotDescription arms_on_legs(RandomRobots& random, bool mobile, int count) {
  dts::RobotDescription robot = chains_of_a_kind(random, mobile, count, arm);
  const dts::RobotDescription arms = chains_of_a_kind(random, mobile, count, arm);
  for (dts::ChainDescription chain : arms.chains) {
    const auto leg = std::size_t(random.integer(0, count - 1));
    chain.carrier = 1 + leg * arm.size() + std::size_t(random.integer(0, 2));
    robot.chains.push_back(chain);
  }
  return robot;
}

TEST(DtsLanes, ChainsOnLinksShareLanesWithThoseOnOtherLinks) {
  RandomRobots random(45);
  for (int count = 1; count <= 6; ++count) {
    for (const bool mobile : {false, true}) {
      const dts::RobotDescription robot = arms_on_legs(random, mobile, count);
      const dts::Model<double> model(robot);
      EXPECT_EQ(model.groups().size(), 2 * (std::size_t(count + 3) / 4));
      expect_like_the_mass_matrix(random, robot, model);
    }
  }
}

TEST(DtsLanes, AChainThatIsNotFiniteLeavesItsNeighboursOnAFixedBaseAlone) {
  RandomRobots random(43);
  dts::RobotDescription robot = chains_of_a_kind(random, false, 4, arm);
  robot.chains[1].links.back().mass = {};
  const dts::Model<double> model(robot);
  dts::Workspace<double> workspace(model);
  const dts::State<double> state = random.state(model);
  dts::forward_dynamics(model, state, {0., 0., -9.81}, random.numbers(12, 5.), workspace);
  for (const std::size_t k : {0u, 2u, 3u}) {
    for (const double a : share(workspace.joint_accelerations, k)) EXPECT_TRUE(std::isfinite(a));
  }
  EXPECT_FALSE(std::ranges::all_of(share(workspace.joint_accelerations, 1),
                                   [](double a) { return std::isfinite(a); }));
}

TEST(DtsLanes, AnImpulseOnOneChainOfAFixedBaseMovesNoOther) {
  RandomRobots random(44);
  const dts::RobotDescription robot = chains_of_a_kind(random, false, 6, arm);
  const dts::Model<double> model(robot);
  dts::Workspace<double> workspace(model);
  dts::forward_kinematics(model, random.state(model), workspace);
  dts::articulated_inertias(model, workspace);
  for (std::size_t struck = 0; struck < 6; ++struck) {
    std::vector<double> change(dts::velocity_count(model));
    const dts::BodyPoint<double> tip{struck * arm.size() + arm.size(), random.vector(1.)};
    dts::velocity_change(model, workspace, tip, random.vector(1.), std::span<double>(change));
    for (std::size_t k = 0; k < 6; ++k) {
      const bool moved = share(change, k) != std::vector<double>(arm.size());
      EXPECT_EQ(moved, k == struck) << k;
    }
  }
}

}  // namespace
}  // namespace hookpoint::tests
