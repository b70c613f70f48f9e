// Forward dynamics, hip wrenches and impulse responses of random robots against the mass matrix
// written out.
#include <gtest/gtest.h>

#include "dts/energy.h"
#include "dts/external_forces.h"
#include "dts/forward_dynamics.h"
#include "dts/impulse_response.h"
#include "dts/inverse_dynamics.h"
#include "tests/support/random_robot.h"

namespace hookpoint::tests {
namespace {

using dts::Model;
using dts::State;
using dts::Workspace;

constexpr double tolerance = 1e-10;

double relative_error(const Eigen::VectorXd& found, const Eigen::VectorXd& truth) {
  if (truth.size() == 0) return found.size() == 0 ? 0. : 1.;
  return (found - truth).lpNorm<Eigen::Infinity>() / truth.lpNorm<Eigen::Infinity>();
}

/// A robot, its state, and everything that acts on it.
struct Case {
  dts::RobotDescription robot;
  Model<double> model;
  State<double> state;
  Vector3d gravity;
  std::vector<double> torques;
  std::vector<DenseForce> forces;

  Case(RandomRobots& random, const dts::RobotDescription& description)
      : robot(description),
        model(robot),
        state(random.state(model)),
        gravity(random.vector(10.)),
        torques(random.numbers(model.link_count(), 5.)) {
    const std::size_t first = robot.mobile ? 0 : 1;
    for (std::size_t body = first; body < model.body_count(); ++body) {
      if (random.chance(0.5)) continue;
      forces.push_back({body, eigen(state.base_position + random.vector(0.5)),
                        eigen(random.vector(10.)), eigen(random.vector(2.))});
    }
  }

  void solve(Workspace<double>& workspace) const {
    apply_forces(workspace);
    dts::forward_dynamics(model, gravity, torques, workspace);
  }
  void apply_forces(Workspace<double>& workspace) const {
    dts::forward_kinematics(model, state, workspace);
    dts::clear_external_forces(workspace);
    for (const DenseForce& x : forces) {
      dts::add_external_force(workspace, x.body, Vector3d{x.force.x(), x.force.y(), x.force.z()},
                              Vector3d{x.point.x(), x.point.y(), x.point.z()});
      dts::add_external_torque(workspace, x.body,
                               Vector3d{x.torque.x(), x.torque.y(), x.torque.z()});
    }
  }
};

/// Calls `check` for robots with 0..8 chains of 1..6 links, fixed and mobile, generic and
/// degenerate, all chains on the base and on any body.
template <class Check>
void for_random_robots(std::uint64_t seed, const Check& check) {
  RandomRobots random(seed);
  for (int chains = 0; chains <= 8; ++chains) {
    for (const bool mobile : {false, true}) {
      for (const bool degenerate : {false, true}) {
        for (int repetition = 0; repetition < 8; ++repetition) {
          if (!mobile && chains == 0) continue;
          SCOPED_TRACE(::testing::Message() << chains << " chains, mobile " << mobile
                                            << ", degenerate " << degenerate << ", " << repetition);
          const Case drawn(random, repetition % 2 == 0 ? random.robot(mobile, chains, degenerate)
                                                       : random.tree(mobile, chains, degenerate));
          check(random, drawn);
        }
      }
    }
  }
}

std::vector<double> accelerations_of(const Model<double>& model,
                                     const Workspace<double>& workspace) {
  std::vector<double> result(dts::velocity_count(model));
  dts::get_acceleration(model, workspace, std::span<double>(result));
  return result;
}
Eigen::VectorXd eigen(const std::vector<double>& a) {
  return Eigen::Map<const Eigen::VectorXd>(a.data(), Eigen::Index(a.size()));
}
using tests::eigen;

void expect_accelerations(const Case& drawn, double within) {
  Workspace<double> workspace(drawn.model);
  drawn.solve(workspace);
  const Eigen::VectorXd truth =
      DenseDynamics(drawn.robot, drawn.state)
          .accelerations(eigen(drawn.gravity), drawn.torques, drawn.forces);
  EXPECT_LE(relative_error(eigen(accelerations_of(drawn.model, workspace)), truth), within);
}

TEST(DtsDense, AccelerationsOfRandomRobots) {
  for_random_robots(
      1, [](RandomRobots&, const Case& drawn) { expect_accelerations(drawn, tolerance); });
}

TEST(DtsDense, FixedBaseDoesNotMove) {
  RandomRobots random(2);
  const Case drawn(random, random.robot(false, 3, false));
  Workspace<double> workspace(drawn.model);
  drawn.solve(workspace);
  EXPECT_EQ(workspace.base_acceleration, Vector3d{});
  EXPECT_EQ(workspace.base_angular_acceleration, Vector3d{});
}

TEST(DtsDense, WorldKinematicsOfRandomRobots) {
  for_random_robots(3, [](RandomRobots&, const Case& drawn) {
    Workspace<double> workspace(drawn.model);
    dts::forward_kinematics(drawn.model, drawn.state, workspace);
    const DenseDynamics dense(drawn.robot, drawn.state);
    for (std::size_t i = 0; i < drawn.model.body_count(); ++i) {
      const auto& body = dense.kinematics().bodies()[i];
      const Eigen::Vector3d v = dense.kinematics().point_jacobian(i, body.p) * dense.velocity();
      const Eigen::Vector3d w = body.J_angular * dense.velocity();
      EXPECT_LE((eigen(workspace.bodies[i].R_WB) - body.R).norm(), 1e-13);
      EXPECT_LE((eigen(workspace.bodies[i].p_WB) - body.p).norm(), 1e-13);
      EXPECT_LE((eigen(workspace.bodies[i].v_WB) - v).norm(), 1e-12);
      EXPECT_LE((eigen(workspace.bodies[i].w_WB) - w).norm(), 1e-12);
    }
  });
}

TEST(DtsDense, HipWrenchesAreNewtonEulerOfTheChain) {
  for_random_robots(4, [](RandomRobots&, const Case& drawn) {
    Workspace<double> workspace(drawn.model);
    drawn.solve(workspace);
    const DenseDynamics dense(drawn.robot, drawn.state);
    const Eigen::Vector3d gravity = eigen(drawn.gravity);
    const Eigen::VectorXd a = dense.accelerations(gravity, drawn.torques, drawn.forces);
    for (std::size_t k = 0; k < drawn.model.chain_count(); ++k) {
      const DenseWrench truth = dense.hip_wrench(k, a, gravity, drawn.forces);
      EXPECT_LE(relative_error(eigen(workspace.hip_wrenches[k].force), truth.force), 1e-9);
      EXPECT_LE(relative_error(eigen(workspace.hip_wrenches[k].moment), truth.moment), 1e-9);
    }
  });
}

TEST(DtsDense, InverseDynamicsTakesWhatTheMassMatrixSays) {
  for_random_robots(9, [](RandomRobots& random, const Case& drawn) {
    Workspace<double> workspace(drawn.model);
    drawn.apply_forces(workspace);
    const std::size_t n = drawn.model.link_count();
    const std::vector<double> joints = random.numbers(n, 5.);
    dts::Accelerations<double> wanted{{}, {}, joints};
    Eigen::VectorXd a(Eigen::Index(dts::velocity_count(drawn.model)));
    a.tail(Eigen::Index(n)) = eigen(joints);
    if (drawn.robot.mobile) {
      wanted.base_angular = random.vector(5.);
      wanted.base_linear = random.vector(5.);
      a.head(6) << eigen(wanted.base_angular), eigen(wanted.base_linear);
    }
    std::vector<double> torques(n);
    const dts::Wrench<double> support = dts::inverse_dynamics(
        drawn.model, drawn.gravity, wanted, std::span<double>(torques), workspace);
    const DenseDynamics dense(drawn.robot, drawn.state);
    const Eigen::VectorXd free =
        dense.accelerations(eigen(drawn.gravity), std::vector<double>(n), drawn.forces);
    const Eigen::VectorXd truth = dense.mass_matrix() * (a - free);
    Eigen::VectorXd found(truth.size());
    if (drawn.robot.mobile) found.head(6) << eigen(support.moment), eigen(support.force);
    found.tail(Eigen::Index(n)) = eigen(torques);
    EXPECT_LE(relative_error(found, truth), tolerance);
  });
}

TEST(DtsDense, EnergyAndMomentaAreSumsOverTheBodies) {
  for_random_robots(10, [](RandomRobots&, const Case& drawn) {
    Workspace<double> workspace(drawn.model);
    dts::forward_kinematics(drawn.model, drawn.state, workspace);
    const DenseMomentum truth = DenseDynamics(drawn.robot, drawn.state).momentum();
    const double energy = dts::kinetic_energy(drawn.model, workspace);
    EXPECT_NEAR(energy, truth.kinetic_energy, tolerance * truth.kinetic_energy);
    const Eigen::Vector3d p = eigen(dts::linear_momentum(drawn.model, workspace));
    const Eigen::Vector3d L = eigen(dts::angular_momentum(drawn.model, workspace));
    EXPECT_LE(relative_error(p, truth.linear), tolerance);
    EXPECT_LE(relative_error(L, truth.angular), tolerance);
  });
}

TEST(DtsDense, ImpulseResponsesAreJMinvJt) {
  for_random_robots(5, [](RandomRobots& random, const Case& drawn) {
    Workspace<double> workspace(drawn.model);
    dts::forward_kinematics(drawn.model, drawn.state, workspace);
    dts::articulated_inertias(drawn.model, workspace);
    const DenseDynamics dense(drawn.robot, drawn.state);
    const Eigen::FullPivLU<Eigen::MatrixXd> M(dense.mass_matrix());
    const int first = drawn.robot.mobile ? 0 : 1;
    const int last = int(drawn.model.body_count()) - 1;
    for (int repetition = 0; repetition < 6; ++repetition) {
      const dts::BodyPoint<double> a{std::size_t(random.integer(first, last)),
                                     drawn.state.base_position + random.vector(0.5)};
      const dts::BodyPoint<double> b{std::size_t(random.integer(first, last)),
                                     drawn.state.base_position + random.vector(0.5)};
      const Eigen::MatrixXd Ja = dense.kinematics().point_jacobian(a.body, eigen(a.p_WP));
      const Eigen::MatrixXd Jb = dense.kinematics().point_jacobian(b.body, eigen(b.p_WP));
      const Eigen::MatrixXd Minv_Jt = M.solve(Ja.transpose());
      const Eigen::Matrix3d K = Ja * Minv_Jt;
      const Eigen::Matrix3d mixed = Jb * Minv_Jt;
      const double size = K.norm() + mixed.norm();
      EXPECT_LE((eigen(dts::collision_matrix(drawn.model, workspace, a)) - K).norm(),
                tolerance * size);
      EXPECT_LE((eigen(dts::impulse_response(drawn.model, workspace, a, b)) - mixed).norm(),
                tolerance * size);
      const Vector3d impulse = random.vector(1.);
      std::vector<double> change(dts::velocity_count(drawn.model));
      dts::velocity_change(drawn.model, workspace, a, impulse, std::span<double>(change));
      EXPECT_LE(relative_error(eigen(change), Minv_Jt * eigen(impulse)), tolerance);
    }
  });
}

TEST(DtsDense, ImpulsesUseTheInertiasThatForwardDynamicsLeaves) {
  RandomRobots random(6);
  const Case drawn(random, random.robot(true, 4, false));
  Workspace<double> workspace(drawn.model);
  drawn.solve(workspace);
  const dts::BodyPoint<double> point{drawn.model.body_count() - 1, random.vector(1.)};
  const Vector3d impulse = random.vector(1.);
  State<double> state = drawn.state;
  dts::apply_impulse(drawn.model, workspace, point, impulse, state);

  const DenseDynamics dense(drawn.robot, drawn.state);
  const Eigen::MatrixXd J = dense.kinematics().point_jacobian(point.body, eigen(point.p_WP));
  const Eigen::VectorXd truth =
      dense.velocity() + dense.mass_matrix().fullPivLu().solve(J.transpose() * eigen(impulse));
  std::vector<double> velocity(dts::velocity_count(drawn.model));
  dts::get_velocity(drawn.model, state, std::span<double>(velocity));
  EXPECT_LE(relative_error(eigen(velocity), truth), tolerance);
}

TEST(DtsDense, AMasslessLinkThatEndsAChainAndCarriesOthers) {
  RandomRobots random(8);
  dts::RobotDescription robot = random.robot(true, 3, false, 0.);
  robot.chains[0].links.back().mass = {};
  const std::size_t shoulder = robot.chains[0].links.size();
  for (const std::size_t arm : {1u, 2u}) robot.chains[arm].carrier = shoulder;
  expect_accelerations(Case(random, robot), 1e-9);
}

TEST(DtsDense, MasslessLinksBeforeAMassiveOne) {
  RandomRobots random(7);
  dts::RobotDescription robot = random.robot(true, 2, false, 0.);
  for (auto& chain : robot.chains) {
    chain.links.resize(3, chain.links.front());
    chain.links[0].mass = {};
    chain.links[1].mass = {};
    chain.links[2].mass = random.mass_properties();
  }
  expect_accelerations(Case(random, robot), 1e-9);
}

}  // namespace
}  // namespace hookpoint::tests
