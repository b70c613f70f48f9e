// Once model, workspace and state exist, a step of the engine allocates nothing.
#include <gtest/gtest.h>

#include "dts/energy.h"
#include "dts/external_forces.h"
#include "dts/forward_dynamics.h"
#include "dts/impulse_response.h"
#include "dts/inverse_dynamics.h"
#include "tests/support/allocation_counter.h"
#include "tests/support/random_robot.h"

namespace hookpoint::tests {
namespace {

/// `branching`: with chains on links.
class DtsAllocation : public ::testing::TestWithParam<bool> {};
INSTANTIATE_TEST_SUITE_P(Branching, DtsAllocation, ::testing::Bool());

TEST_P(DtsAllocation, AStepAllocatesNothing) {
  RandomRobots random(31);
  const dts::Model<double> model(GetParam() ? random.tree(true, 8, false)
                                            : random.robot(true, 5, false));
  ASSERT_EQ(model.branches(), GetParam());
  dts::Workspace<double> workspace(model);
  dts::State<double> state = random.state(model);
  std::vector<double> torques = random.numbers(model.link_count(), 1.);
  std::vector<double> tangent(dts::velocity_count(model));
  const Vector3d gravity{0., 0., -9.81};
  const dts::BodyPoint<double> point{model.body_count() - 1, {}};

  const long before = testing::allocation_count();
  dts::forward_kinematics(model, state, workspace);
  dts::clear_external_forces(workspace);
  dts::add_external_force(workspace, 1, {1., 2., 3.}, Vector3d{});
  dts::forward_dynamics(model, state, gravity, torques, workspace);
  dts::get_velocity(model, state, std::span<double>(tangent));
  dts::retract(model, state, tangent, 1e-3, state);
  dts::get_acceleration(model, workspace, std::span<double>(tangent));
  dts::set_velocity(model, tangent, state);
  dts::inverse_dynamics(model, gravity, {{}, {}, workspace.joint_accelerations},
                        std::span<double>(torques), workspace);
  dts::articulated_inertias(model, workspace);
  dts::collision_matrix(model, workspace, point);
  dts::velocity_change(model, workspace, point, {1., 0., 0.}, std::span<double>(tangent));
  dts::apply_impulse(model, workspace, point, {1., 0., 0.}, state);
  dts::kinetic_energy(model, workspace);
  dts::potential_energy(model, gravity, workspace);
  dts::angular_momentum(model, workspace);
  EXPECT_EQ(testing::allocation_count(), before);
}

TEST(AllocationCounter, TheCounterCounts) {
  const long before = testing::allocation_count();
  const std::vector<double> something(10);
  EXPECT_GT(testing::allocation_count(), before) << something.size();
}

}  // namespace
}  // namespace hookpoint::tests
