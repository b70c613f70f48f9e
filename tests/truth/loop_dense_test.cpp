// Accelerations of random robots with loops and coupled joints against the mass matrix and multipliers
// written out:
//   [M  J^T; J  0] [v'; -lambda] = [f; -J' v].
#include <gtest/gtest.h>

#include "dts/configuration.h"
#include "dts/forward_dynamics.h"
#include "simulation/dts_engine/constraint_set.h"
#include "tests/support/random_robot.h"

namespace hookpoint::tests {
namespace {

using simulation::ConstraintSet;

struct Place {
  std::size_t body;
  Eigen::Vector3d x;
};

/// J and J' v of two places that stay together.
struct Rows {
  Eigen::MatrixXd J;
  Eigen::VectorXd bias;

  void add(const DenseDynamics& dense, const Place& a, const Place& b) {
    const Eigen::Index row = J.rows();
    J.conservativeResize(row + 3, dense.velocity().size());
    bias.conservativeResize(row + 3);
    const auto& kinematics = dense.kinematics();
    J.middleRows(row, 3) =
        kinematics.point_jacobian(a.body, a.x) - kinematics.point_jacobian(b.body, b.x);
    bias.segment(row, 3) = dense.point_bias(a.body, a.x) - dense.point_bias(b.body, b.x);
  }

  void add(const simulation::CouplingSpec& coupling, Eigen::Index first_joint) {
    const Eigen::Index row = J.rows();
    J.conservativeResize(row + 1, Eigen::NoChange);
    bias.conservativeResize(row + 1);
    J.row(row).setZero();
    J(row, first_joint + Eigen::Index(coupling.follower)) = 1.;
    J(row, first_joint + Eigen::Index(coupling.leader)) = -coupling.ratio;
    bias[row] = 0.;
  }
};

Vector3d ours(const Eigen::Vector3d& a) { return {a.x(), a.y(), a.z()}; }

TEST(LoopDense, AccelerationsOfRandomRobotsWithLoopsAndCoupledJoints) {
  RandomRobots random(2027);
  int solved = 0, hinges = 0, coupled = 0;
  double worst = 0.;
  for (int k = 0; k < 2000 && solved < 200; ++k) {
    const dts::RobotDescription robot =
        random.tree(random.chance(0.5), random.integer(2, 5), false);
    const dts::Model<double> model(robot);
    const dts::State<double> state = random.state(model);
    const Vector3d gravity = random.vector(10.);
    const std::vector<double> torques = random.numbers(model.link_count(), 5.);
    const DenseDynamics dense(robot, state);
    dts::Workspace<double> workspace(model);
    dts::forward_kinematics(model, state, workspace);

    simulation::Experiment experiment;
    experiment.robots.resize(1);
    Rows rows;
    rows.J.resize(0, dense.velocity().size());
    const int loops = random.integer(0, 2);
    for (int l = 0; l < loops; ++l) {
      const auto a = std::size_t(random.integer(1, int(model.body_count()) - 1));
      const auto b = std::size_t(random.integer(0, int(a) - 1));
      const bool hinge = random.chance(0.4);
      const Eigen::Vector3d x = eigen(state.base_position + random.vector(0.6));
      const Eigen::Vector3d axis = eigen(random.vector(1.)).normalized();
      const auto in_body = [&](std::size_t body, const Eigen::Vector3d& p) -> Vector3d {
        const auto& at = dense.kinematics().bodies()[body];
        return ours(at.R.transpose() * (p - at.p));
      };
      const auto turned = [&](std::size_t body) -> Vector3d {
        return ours(dense.kinematics().bodies()[body].R.transpose() * axis);
      };
      simulation::LoopSpec loop;
      loop.body_a = int(a);
      loop.body_b = int(b);
      loop.point_a = in_body(a, x);
      loop.point_b = in_body(b, x);
      rows.add(dense, {a, x}, {b, x});
      if (hinge) {
        loop.axes = {turned(a), turned(b)};
        rows.add(dense, {a, x + axis}, {b, x + axis});
      }
      experiment.loops.push_back(loop);
      hinges += hinge ? 1 : 0;
    }
    const int joints = int(model.link_count());
    const int couplings = std::min(random.integer(loops == 0 ? 1 : 0, 2), joints - 1);
    for (int c = 0; c < couplings; ++c) {
      // Each follows one before it: a joint follows at most one.
      simulation::CouplingSpec coupling;
      coupling.follower = std::size_t(joints - 1 - c);
      coupling.leader = std::size_t(random.integer(0, joints - 2 - c));
      coupling.ratio = random.uniform(-3., 3.);
      experiment.couplings.push_back(coupling);
      rows.add(coupling, dense.velocity().size() - joints);
    }
    coupled += couplings > 0 ? 1 : 0;

    const Eigen::VectorXd open = dense.accelerations(eigen(gravity), torques, {});
    const Eigen::MatrixXd MJ = dense.mass_matrix().fullPivLu().solve(rows.J.transpose());
    const Eigen::MatrixXd A = rows.J * MJ;
    const Eigen::CompleteOrthogonalDecomposition<Eigen::MatrixXd> decomposition(A);
    ConstraintSet set(experiment, 0, model);
    const std::vector<dts::Wrench<double>> external = workspace.external;
    using Closing = ConstraintSet::Closing;
    for (const auto& [closing, share] :
         {std::pair{Closing::at_this_moment, 1.}, std::pair{Closing::over_a_step, 0.5}}) {
      const Eigen::VectorXd needed = -(rows.J * open + share * rows.bias);
      const Eigen::VectorXd lambda = decomposition.solve(needed);
      // Loops that leave the robot no motion that meets them, and those nearly so, have no answer to
      // compare.
      if ((A * lambda - needed).norm() > 1e-9 * needed.norm()) continue;
      const Eigen::VectorXd truth = open + MJ * lambda;
      if (truth.norm() > 1e3 * (1. + open.norm())) continue;

      workspace.external = external;
      dts::forward_dynamics(model, gravity, torques, workspace);
      set.find_forces(model, state, workspace, closing);
      std::vector<double> driven = torques;
      set.add_forces(workspace, driven);
      dts::forward_dynamics(model, gravity, driven, workspace);
      std::vector<double> found(dense.velocity().size());
      dts::get_acceleration<double>(model, workspace, found);
      const Eigen::VectorXd ours_found = Eigen::Map<Eigen::VectorXd>(found.data(), found.size());
      const double error = (ours_found - truth).norm() / truth.norm();
      EXPECT_LT(error, 1e-9) << "robot " << k << ", rank " << set.rank() << " of "
                             << set.row_count();
      worst = std::max(worst, error);
      solved += closing == Closing::at_this_moment ? 1 : 0;
    }
  }
  EXPECT_GE(solved, 200);
  EXPECT_GT(hinges, 40);
  EXPECT_GT(coupled, 80);
  RecordProperty("worst", std::to_string(worst));
}

}  // namespace
}  // namespace hookpoint::tests
