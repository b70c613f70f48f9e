#include <gtest/gtest.h>

#include "dts/joint_forces.h"

namespace hookpoint::dts {
namespace {

TEST(JointForces, NothingByDefault) {
  EXPECT_EQ(passive_joint_torque(JointProperties<double>{}, 12., -7.), 0.);
}

TEST(JointForces, DamperAndSpring) {
  JointProperties<double> joint;
  joint.damping = 2.;
  joint.stiffness = 10.;
  joint.rest_position = 0.5;
  EXPECT_DOUBLE_EQ(passive_joint_torque(joint, 0.8, 3.), -6. - 3.);
}

TEST(JointForces, DryFrictionOpposesTheRateAndIsViscousBelowItsSpeed) {
  JointProperties<double> joint;
  joint.friction = 4.;
  joint.friction_speed = 0.1;
  EXPECT_DOUBLE_EQ(passive_joint_torque(joint, 0., 7.), -4.);
  EXPECT_DOUBLE_EQ(passive_joint_torque(joint, 0., -7.), 4.);
  EXPECT_DOUBLE_EQ(passive_joint_torque(joint, 0., 0.025), -1.);
  EXPECT_DOUBLE_EQ(passive_joint_torque(joint, 0., 0.), 0.);
}

TEST(JointForces, StopsPushBackAndNeverPull) {
  JointProperties<double> joint;
  joint.lower_limit = -1.;
  joint.upper_limit = 2.;
  joint.limit_stiffness = 100.;
  joint.limit_damping = 5.;
  EXPECT_DOUBLE_EQ(passive_joint_torque(joint, 0., 9.), 0.);
  EXPECT_DOUBLE_EQ(passive_joint_torque(joint, 2.125, 0.), -12.5);
  EXPECT_DOUBLE_EQ(passive_joint_torque(joint, -1.125, 0.), 12.5);
  EXPECT_DOUBLE_EQ(passive_joint_torque(joint, 2.125, 1.), -17.5);
  EXPECT_DOUBLE_EQ(passive_joint_torque(joint, -1.125, -1.), 17.5);
  EXPECT_DOUBLE_EQ(passive_joint_torque(joint, 2.125, -50.), 0.);
  EXPECT_DOUBLE_EQ(passive_joint_torque(joint, 1.99, 50.), 0.);
}

}  // namespace
}  // namespace hookpoint::dts
