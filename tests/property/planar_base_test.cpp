// A base that is kept in a plane against the mass matrix written out, its held rows and columns
// left out, and against what it must conserve.
#include "dts/planar_base.h"

#include <gtest/gtest.h>

#include "dts/external_forces.h"
#include "dts/forward_dynamics.h"
#include "dts/impulse_response.h"
#include "tests/support/random_robot.h"

namespace hookpoint::tests {
namespace {

constexpr double tolerance = 1e-10;

/// A drawn robot whose base moves in a drawn plane of world axes.
struct Drawn {
  dts::RobotDescription robot;
  dts::Model<double> model;
  dts::State<double> state;
  std::vector<int> free;  // of all velocities
  dts::Workspace<double> workspace;
  DenseDynamics truth;

  Drawn(RandomRobots& random, int chains, std::size_t normal)
      : robot(in_plane(random.robot(true, chains, chains % 2 == 0), normal)),
        model(robot),
        state(drawn_state(random, model, normal)),
        workspace(model),
        truth(robot, state) {
    for (int k = 0; k < truth.mass_matrix().rows(); ++k)
      if (k >= 6 || !dts::held_in_plane(static_cast<std::size_t>(k), normal)) free.push_back(k);
    dts::forward_kinematics(model, state, workspace);
  }

  static dts::RobotDescription in_plane(dts::RobotDescription robot, std::size_t normal) {
    robot.plane_normal = normal;
    return robot;
  }
  static dts::State<double> drawn_state(RandomRobots& random, const dts::Model<double>& model,
                                        std::size_t normal) {
    dts::State<double> state = random.state(model);
    const Vector3d along = state.base_velocity;
    const double turn = state.base_angular_velocity.x;
    state.base_velocity = {normal == 0 ? 0. : along.x, normal == 1 ? 0. : along.y,
                           normal == 2 ? 0. : along.z};
    state.base_angular_velocity = {normal == 0 ? turn : 0., normal == 1 ? turn : 0.,
                                   normal == 2 ? turn : 0.};
    return state;
  }

  /// x of M_ff x = f_f, the held ones 0.
  Eigen::VectorXd constrained(const Eigen::VectorXd& f) const {
    const Eigen::MatrixXd M = truth.mass_matrix()(free, free);
    Eigen::VectorXd x = Eigen::VectorXd::Zero(f.size());
    const Eigen::VectorXd f_free = f(free);
    x(free) = Eigen::VectorXd(M.ldlt().solve(f_free));
    return x;
  }
};

template <class Check>
void for_drawn(std::uint64_t seed, Check&& check) {
  RandomRobots random(seed);
  for (int repetition = 0; repetition < 60; ++repetition) {
    Drawn x(random, repetition % 6, static_cast<std::size_t>(repetition % 3));
    check(x, random);
  }
}

double relative_error(const Eigen::VectorXd& found, const Eigen::VectorXd& truth) {
  return (found - truth).lpNorm<Eigen::Infinity>() / truth.lpNorm<Eigen::Infinity>();
}

TEST(PlanarBase, AcceleratesAsTheEquationsOfItsFreeDirections) {
  for_drawn(71, [](Drawn& x, RandomRobots& random) {
    const Vector3d g = random.vector(10.);
    const auto torques = random.numbers(x.model.link_count(), 5.);
    const Vector3d push = random.vector(20.), at = x.state.base_position + random.vector(0.5);
    dts::clear_external_forces(x.workspace);
    dts::add_external_force(x.workspace, 0, push, at);
    dts::forward_dynamics<double>(x.model, g, torques, x.workspace);
    Eigen::VectorXd found(x.truth.mass_matrix().rows());
    dts::get_acceleration<double>(x.model, x.workspace,
                                  {found.data(), static_cast<std::size_t>(found.size())});
    const DenseForce force{0, eigen(at), eigen(push), Eigen::Vector3d::Zero()};
    const Eigen::VectorXd f =
        x.truth.mass_matrix() * x.truth.accelerations(eigen(g), torques, {force});
    EXPECT_LE(relative_error(found, x.constrained(f)), tolerance);
    for (int k = 0; k < 6; ++k) {
      if (!dts::held_in_plane(static_cast<std::size_t>(k), *x.robot.plane_normal)) continue;
      EXPECT_EQ(found[k], 0.) << "exactly: nothing drifts out of the plane";
    }
  });
}

TEST(PlanarBase, AnswersImpulsesWithinItsPlane) {
  for_drawn(72, [](Drawn& x, RandomRobots& random) {
    dts::articulated_inertias(x.model, x.workspace);
    const std::size_t body = x.model.body_count() - 1;
    const Vector3d at = x.state.base_position + random.vector(0.5), P = random.vector(3.);
    Eigen::VectorXd change(x.truth.mass_matrix().rows());
    dts::velocity_change<double>(x.model, x.workspace, {body, at}, P,
                                 {change.data(), static_cast<std::size_t>(change.size())});
    const Eigen::VectorXd f =
        x.truth.kinematics().point_jacobian(body, eigen(at)).transpose() * eigen(P);
    EXPECT_LE(relative_error(change, x.constrained(f)), tolerance);
  });
}

}  // namespace
}  // namespace hookpoint::tests
