// Mass matrix, bias and gravity forces, Jacobians and the centre of mass of drawn robots against
// the mass matrix written out.
#include <gtest/gtest.h>

#include "dts/bias_forces.h"
#include "dts/energy.h"
#include "dts/forward_kinematics.h"
#include "dts/jacobian.h"
#include "dts/mass_matrix.h"
#include "tests/support/random_robot.h"

namespace hookpoint::tests {
namespace {

using Rows = Eigen::Matrix<double, Eigen::Dynamic, Eigen::Dynamic, Eigen::RowMajor>;

Rows rows(const std::vector<double>& numbers, Eigen::Index count) {
  return Eigen::Map<const Rows>(numbers.data(), count,
                                static_cast<Eigen::Index>(numbers.size()) / count);
}

/// Relative to the larger of what is compared; absolute near 0.
void expect_near(const Eigen::MatrixXd& found, const Eigen::MatrixXd& truth, const char* what) {
  ASSERT_EQ(found.rows(), truth.rows()) << what;
  ASSERT_EQ(found.cols(), truth.cols()) << what;
  EXPECT_LE((found - truth).cwiseAbs().maxCoeff(), 1e-10 * (1. + truth.cwiseAbs().maxCoeff()))
      << what;
}

struct Drawn {
  dts::RobotDescription robot;
  dts::Model<double> model;
  dts::State<double> state;
  dts::Workspace<double> workspace;
  DenseDynamics truth;
  dts::CompositeBodies composite;

  Drawn(RandomRobots& random, bool mobile, int chains, bool degenerate, bool branching)
      : robot(branching ? random.tree(mobile, chains, degenerate)
                        : random.robot(mobile, chains, degenerate)),
        model(robot),
        state(random.state(model)),
        workspace(model),
        truth(robot, state) {
    dts::forward_kinematics(model, state, workspace);
    composite = dts::composite_bodies(model, workspace);
  }
  Eigen::Index size() const { return truth.mass_matrix().rows(); }
  const Vector3d& origin() const { return state.base_position; }
};

template <class Check>
void for_drawn(std::uint64_t seed, Check&& check) {
  RandomRobots random(seed);
  for (int repetition = 0; repetition < 120; ++repetition) {
    Drawn x(random, repetition % 2 == 0, 1 + repetition % 6, repetition % 3 == 0, repetition >= 60);
    check(x, random);
  }
}

TEST(ControllerTerms, TheMassMatrixIsThatOfTheJacobians) {
  for_drawn(31, [](Drawn& x, RandomRobots&) {
    const Rows M = rows(dts::mass_matrix(x.model, x.composite), x.size());
    expect_near(M, x.truth.mass_matrix(), "M");
    const double T = dts::kinetic_energy(x.model, x.workspace);
    EXPECT_NEAR(0.5 * x.truth.velocity().dot(M * x.truth.velocity()), T, 1e-10 * (1. + T));
  });
}

TEST(ControllerTerms, BiasForcesHoldTheAccelerationsAtZero) {
  for_drawn(32, [](Drawn& x, RandomRobots& random) {
    const Vector3d g = random.vector(10.);
    const std::vector<double> h = dts::bias_forces(x.model, g, x.workspace);
    // M v' + h = 0 is what moves freely.
    const std::vector<double> none(x.state.joint_rates.size());
    const Eigen::VectorXd free = x.truth.accelerations(eigen(g), none, {});
    expect_near(rows(h, x.size()), -x.truth.mass_matrix() * free, "h");
  });
}

TEST(ControllerTerms, GravityForcesAreTheBiasOfARobotAtRest) {
  for_drawn(33, [](Drawn& x, RandomRobots& random) {
    const Vector3d g = random.vector(10.);
    x.state.base_velocity = x.state.base_angular_velocity = {};
    for (double& rate : x.state.joint_rates) rate = 0.;
    dts::forward_kinematics(x.model, x.state, x.workspace);
    const DenseDynamics still(x.robot, x.state);
    const std::vector<double> none(x.state.joint_rates.size());
    const Eigen::VectorXd truth = -x.truth.mass_matrix() * still.accelerations(eigen(g), none, {});
    const dts::CenterOfMass center = dts::center_of_mass(x.model, x.composite, x.origin());
    expect_near(rows(dts::gravity_forces(center, g), x.size()), truth, "by the centre of mass");
    expect_near(rows(dts::bias_forces(x.model, g, x.workspace), x.size()), truth, "by the bias");
  });
}

TEST(ControllerTerms, JacobiansOfBodiesAreThoseOfTheirPoints) {
  for_drawn(34, [](Drawn& x, RandomRobots& random) {
    for (std::size_t body = 0; body < x.model.body_count(); ++body) {
      const Vector3d point = random.vector(2.);
      const Rows J = rows(dts::body_jacobian(x.model, x.composite, x.origin(), body, point), 6);
      expect_near(J.topRows(3), x.truth.kinematics().bodies()[body].J_angular, "angular");
      expect_near(J.bottomRows(3), x.truth.kinematics().point_jacobian(body, eigen(point)),
                  "linear");
    }
  });
}

TEST(ControllerTerms, TheCentreOfMassIsThatOfItsBodies) {
  for_drawn(35, [](Drawn& x, RandomRobots&) {
    double mass = 0.;
    Eigen::Vector3d position = Eigen::Vector3d::Zero();
    Eigen::MatrixXd jacobian = Eigen::MatrixXd::Zero(3, x.size());
    std::size_t i = 0;
    const auto add = [&](const dts::MassProperties<double>& body) {
      const auto& at = x.truth.kinematics().bodies()[i++];
      mass += body.mass;
      position += body.mass * at.c;
      jacobian += body.mass * at.J_linear;
    };
    add(x.robot.mobile ? x.robot.base : dts::MassProperties<double>{});
    for (const auto& chain : x.robot.chains)
      for (const auto& link : chain.links) add(link.mass);
    const dts::CenterOfMass center = dts::center_of_mass(x.model, x.composite, x.origin());
    EXPECT_NEAR(center.mass, mass, 1e-12 * mass);
    expect_near(eigen(center.position), position / mass, "c");
    expect_near(rows(center.jacobian, 3), jacobian / mass, "dc/dv");
  });
}

}  // namespace
}  // namespace hookpoint::tests
