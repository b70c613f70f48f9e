// Accelerations of bodies against difference quotients of their velocities along the motion.
#include "dts/body_accelerations.h"

#include <gtest/gtest.h>

#include "dts/forward_dynamics.h"
#include "tests/support/random_robot.h"

namespace hookpoint::dts {
namespace {

TEST(BodyAccelerations, AreTheRatesOfTheBodiesVelocities) {
  tests::RandomRobots random(21);
  for (int k = 0; k < 20; ++k) {
    const int chains = random.integer(1, 5);
    const RobotDescription robot = k < 10 ? random.robot(k % 2 == 0, chains, k % 3 == 0)
                                          : random.tree(k % 2 == 0, chains, k % 3 == 0);
    const Model<double> model(robot);
    const State<double> state = random.state(model);
    const std::vector<double> torques = random.numbers(model.link_count(), 2.);
    Workspace<double> workspace(model);
    forward_dynamics<double>(model, state, {0., 0., -9.81}, torques, workspace);
    std::vector<Motion<double>> found(model.body_count());
    body_accelerations<double>(model, state, workspace, found);

    std::vector<double> v(velocity_count(model)), a(v);
    get_velocity<double>(model, state, v);
    get_acceleration<double>(model, workspace, a);
    const double h = 1e-5;
    std::vector<BodyMotion<double>> ends[2];
    for (const int side : {0, 1}) {
      // q + v h + a h^2/2 and v + a h, forwards and backwards: error O(h^2) of the quotient.
      const double dt = side == 0 ? -h : h;
      std::vector<double> mean(v), late(v);
      for (std::size_t i = 0; i < v.size(); ++i) {
        mean[i] += 0.5 * dt * a[i];
        late[i] += dt * a[i];
      }
      State<double> moved = state;
      retract<double>(model, state, mean, dt, moved);
      set_velocity<double>(model, late, moved);
      Workspace<double> there(model);
      forward_kinematics(model, moved, there);
      ends[side] = there.bodies;
    }
    for (std::size_t body = 0; body < model.body_count(); ++body) {
      const Vector3d linear = (0.5 / h) * (ends[1][body].v_WB - ends[0][body].v_WB);
      const Vector3d angular = (0.5 / h) * (ends[1][body].w_WB - ends[0][body].w_WB);
      EXPECT_LT(norm(found[body].linear - linear), 1e-5 * (1. + norm(linear)));
      EXPECT_LT(norm(found[body].angular - angular), 1e-5 * (1. + norm(angular)));
    }
  }
}

}  // namespace
}  // namespace hookpoint::dts
