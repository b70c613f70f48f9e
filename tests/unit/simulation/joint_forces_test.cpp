#include "simulation/experiment/joint_forces.h"

#include <gtest/gtest.h>

#include <cmath>
#include <random>

namespace hookpoint::simulation {
namespace {

TEST(JointForces, NothingByDefault) {
  EXPECT_EQ(passive_joint_torque(JointProperties{}, 12., -7., 3.), 0.);
}

TEST(JointForces, DamperAndSpring) {
  JointProperties joint;
  joint.damping = 2.;
  joint.stiffness = 10.;
  joint.rest_position = 0.5;
  EXPECT_DOUBLE_EQ(passive_joint_torque(joint, 0.8, 3., 0.), -6. - 3.);
}

TEST(JointForces, DryFrictionIsASpringAndADamperUpToItsTorque) {
  JointProperties joint;
  joint.friction = 4.;
  joint.friction_speed = 0.1;
  joint.friction_deflection = 0.01;
  EXPECT_DOUBLE_EQ(passive_joint_torque(joint, 0.5, 7., 0.5), -4.);
  EXPECT_DOUBLE_EQ(passive_joint_torque(joint, 0.5, -7., 0.5), 4.);
  EXPECT_DOUBLE_EQ(passive_joint_torque(joint, 0.5, 0.025, 0.5), -1.);
  EXPECT_DOUBLE_EQ(passive_joint_torque(joint, 0.5, 0., 0.5), 0.);
  EXPECT_NEAR(passive_joint_torque(joint, 0.505, 0., 0.5), -2., 1e-12);
  EXPECT_NEAR(passive_joint_torque(joint, 0.495, 0.025, 0.5), 1., 1e-12);
  // Dragged along it brakes with all of its torque, however slow.
  EXPECT_DOUBLE_EQ(passive_joint_torque(joint, 0.75, 1e-9, 0.5), -4.);
}

TEST(JointForces, AnchorIsDraggedBeyondTheDeflection) {
  JointProperties joint;
  joint.friction_deflection = 0.25;
  EXPECT_EQ(dragged_anchor(joint, 1.25, 1.), 1.);
  EXPECT_EQ(dragged_anchor(joint, 0.75, 1.), 1.);
  EXPECT_EQ(dragged_anchor(joint, 2., 1.), 1.75);
  EXPECT_EQ(dragged_anchor(joint, -1., 1.), -0.75);
}

// On any path friction takes at least what its spring stores: summed with the torque at the end of
// each step, which for a spring is the larger part of the step's work.
TEST(JointForces, FrictionGivesNothingThatWasNotStored) {
  std::mt19937 random(11);
  std::normal_distribution<double> normal;
  for (int path = 0; path < 200; ++path) {
    JointProperties joint;
    joint.friction = std::exp(normal(random));
    joint.friction_deflection = std::exp(normal(random) - 3.);
    joint.friction_speed = path % 4 == 0 ? 1e9 : std::exp(normal(random));
    const double stiffness = joint.friction / joint.friction_deflection;
    const double dt = 0.01, reach = std::exp(2. * normal(random)) * joint.friction_deflection;
    double q = normal(random), anchor = q, taken = 0.;
    for (int i = 0; i < 500; ++i) {
      const double way = reach * normal(random);
      q += way;
      anchor = dragged_anchor(joint, q, anchor);
      const double torque = passive_joint_torque(joint, q, way / dt, anchor);
      ASSERT_LE(std::abs(torque), joint.friction * (1. + 1e-12));
      taken -= torque * way;
      const double stored = 0.5 * stiffness * (q - anchor) * (q - anchor);
      ASSERT_GE(taken, stored - 1e-9 * (1. + taken)) << path << " " << i;
    }
  }
}

TEST(JointForces, StopsPushBackAndNeverPull) {
  JointProperties joint;
  joint.lower_limit = -1.;
  joint.upper_limit = 2.;
  joint.limit_stiffness = 100.;
  joint.limit_damping = 5.;
  EXPECT_DOUBLE_EQ(passive_joint_torque(joint, 0., 9., 0.), 0.);
  EXPECT_DOUBLE_EQ(passive_joint_torque(joint, 2.125, 0., 0.), -12.5);
  EXPECT_DOUBLE_EQ(passive_joint_torque(joint, -1.125, 0., 0.), 12.5);
  EXPECT_DOUBLE_EQ(passive_joint_torque(joint, 2.125, 1., 0.), -17.5);
  EXPECT_DOUBLE_EQ(passive_joint_torque(joint, -1.125, -1., 0.), 17.5);
  EXPECT_DOUBLE_EQ(passive_joint_torque(joint, 2.125, -50., 0.), 0.);
  EXPECT_DOUBLE_EQ(passive_joint_torque(joint, 1.99, 50., 0.), 0.);
}

}  // namespace
}  // namespace hookpoint::simulation
