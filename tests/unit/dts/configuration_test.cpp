#include "dts/configuration.h"

#include <gtest/gtest.h>

#include <array>
#include <numbers>

namespace hookpoint::dts {
namespace {

Model<double> model_of(bool mobile, std::size_t links) {
  RobotDescription robot;
  robot.mobile = mobile;
  robot.base = {1., {}, {1., 1., 1., 0., 0., 0.}};
  robot.chains.emplace_back();
  robot.chains[0].links.resize(links);
  for (LinkDescription& link : robot.chains[0].links) link.mass = robot.base;
  return Model<double>(robot);
}

TEST(Configuration, Sizes) {
  EXPECT_EQ(position_count(model_of(true, 2)), 9u);
  EXPECT_EQ(velocity_count(model_of(true, 2)), 8u);
  EXPECT_EQ(position_count(model_of(false, 2)), 2u);
  EXPECT_EQ(velocity_count(model_of(false, 2)), 2u);
}

TEST(Configuration, VelocityIsAngularThenLinearThenJoints) {
  const Model<double> model = model_of(true, 2);
  State<double> state = zero_state(model);
  const std::array velocity{1., 2., 3., 4., 5., 6., 7., 8.};
  set_velocity(model, velocity, state);
  EXPECT_EQ(state.base_angular_velocity, (Vector3d{1., 2., 3.}));
  EXPECT_EQ(state.base_velocity, (Vector3d{4., 5., 6.}));
  EXPECT_EQ(state.joint_rates, (std::vector{7., 8.}));
  std::array<double, 8> back{};
  get_velocity(model, state, std::span<double>(back));
  EXPECT_EQ(back, velocity);
}

TEST(Configuration, BaseTurnsAboutWorldAxes) {
  const Model<double> model = model_of(true, 1);
  State<double> state = zero_state(model);
  const double quarter = std::numbers::pi / 2.;
  state.base_orientation = exponential(Vector3d{quarter, 0., 0.});
  // A quarter turn about the world's z takes the body's y, which points up, to itself, and its x to
  // world y.
  const std::array tangent{0., 0., quarter, 10., 0., 0., 3.};
  retract(model, state, tangent, 1., state);
  const Matrix3d R = rotation_matrix(state.base_orientation);
  EXPECT_NEAR(norm(R * Vector3d{0., 1., 0.} - Vector3d{0., 0., 1.}), 0., 1e-15);
  EXPECT_NEAR(norm(R * Vector3d{1., 0., 0.} - Vector3d{0., 1., 0.}), 0., 1e-15);
  EXPECT_EQ(state.base_position, (Vector3d{10., 0., 0.}));
  EXPECT_EQ(state.joint_positions[0], 3.);
}

TEST(Configuration, FixedBaseStays) {
  const Model<double> model = model_of(false, 1);
  State<double> state = zero_state(model);
  state.base_position = {1., 2., 3.};
  State<double> to = zero_state(model);
  retract(model, state, std::array{2.}, 0.5, to);
  EXPECT_EQ(to.base_position, state.base_position);
  EXPECT_EQ(to.joint_positions[0], 1.);
}

}  // namespace
}  // namespace hookpoint::dts
