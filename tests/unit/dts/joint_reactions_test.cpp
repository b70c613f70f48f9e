// Joint reactions against what is known of them without the recursion: along its axis a joint transmits
// its torque, a base that moves freely is held by nothing, and chains push their hips by as much.
#include "dts/joint_reactions.h"

#include <gtest/gtest.h>

#include "dts/body_accelerations.h"
#include "dts/external_forces.h"
#include "dts/forward_dynamics.h"
#include "tests/support/random_robot.h"

namespace hookpoint::dts {
namespace {

TEST(JointReactions, TransmitTorquesAndLeaveAFreeBaseFree) {
  tests::RandomRobots random(33);
  const Vector3<double> gravity{0.3, -0.2, -9.81};
  for (int k = 0; k < 20; ++k) {
    const bool mobile = k % 2 == 0;
    const RobotDescription robot = random.tree(mobile, random.integer(1, 5), k % 3 == 0);
    const Model<double> model(robot);
    const State<double> state = random.state(model);
    const std::vector<double> torques = random.numbers(model.link_count(), 2.);
    Workspace<double> workspace(model);
    forward_kinematics(model, state, workspace);
    clear_external_forces(workspace);
    for (std::size_t body = 0; body < model.body_count(); ++body)
      add_external_force(workspace, body, {1., -2., 3.},
                         workspace.bodies[body].p_WB + Vector3<double>{0.1, 0.2, -0.1});
    forward_dynamics<double>(model, gravity, torques, workspace);
    std::vector<Motion<double>> accelerations(model.body_count());
    body_accelerations<double>(model, state, workspace, accelerations);
    std::vector<Wrench<double>> reactions(model.body_count());
    joint_reactions<double>(model, gravity, workspace, accelerations, reactions);

    if (mobile) {
      EXPECT_LT(norm(reactions[0].force), 1e-9);
      EXPECT_LT(norm(reactions[0].moment), 1e-9);
    }
    std::size_t chain = 0;
    for (std::size_t body = 1; body < model.body_count(); ++body) {
      const Matrix3<double>& R = workspace.bodies[body].R_WB;
      const Vector3<double> axis{R.xz, R.yz, R.zz};
      const Seat& seat = model.seat_of(body);
      const bool turns = model.groups()[seat.group].links[seat.link].joint == JointType::revolute;
      const Wrench<double>& on_link = reactions[body];
      const double rotor = model.groups()[seat.group].links[seat.link].rotor_inertia[seat.lane] *
                           workspace.joint_accelerations[body - 1];
      EXPECT_NEAR(dot(axis, turns ? on_link.moment : on_link.force) + rotor, torques[body - 1],
                  1e-9);
      if (seat.link == 0) {
        EXPECT_LT(norm(workspace.hip_wrenches[chain++].force + on_link.force), 1e-9);
      }
    }
  }
}

}  // namespace
}  // namespace hookpoint::dts
