#include "simulation/experiment/joint_forces.h"

#include <gtest/gtest.h>

#include <cmath>
#include <random>

namespace hookpoint::simulation {
namespace {

TEST(JointForces, NothingByDefault) {
  EXPECT_EQ(passive_joint_torque(JointProperties{}, 12., -7., {3.}), 0.);
}

TEST(JointForces, DamperAndSpring) {
  JointProperties joint;
  joint.damping = 2.;
  joint.stiffness = 10.;
  joint.rest_position = 0.5;
  EXPECT_DOUBLE_EQ(passive_joint_torque(joint, 0.8, 3., {0.}), -6. - 3.);
}

TEST(JointForces, DryFrictionIsASpringAndADamperUpToItsTorque) {
  JointProperties joint;
  joint.friction = 4.;
  joint.friction_speed = 0.1;
  joint.friction_deflection = 0.01;
  EXPECT_DOUBLE_EQ(passive_joint_torque(joint, 0.5, 7., {0.5}), -4.);
  EXPECT_DOUBLE_EQ(passive_joint_torque(joint, 0.5, -7., {0.5}), 4.);
  EXPECT_DOUBLE_EQ(passive_joint_torque(joint, 0.5, 0.025, {0.5}), -1.);
  EXPECT_DOUBLE_EQ(passive_joint_torque(joint, 0.5, 0., {0.5}), 0.);
  EXPECT_NEAR(passive_joint_torque(joint, 0.505, 0., {0.5}), -2., 1e-12);
  EXPECT_NEAR(passive_joint_torque(joint, 0.495, 0.025, {0.5}), 1., 1e-12);
  // Dragged along it brakes with all of its torque, however slow.
  EXPECT_DOUBLE_EQ(passive_joint_torque(joint, 0.75, 1e-9, {0.5}), -4.);
}

TEST(JointForces, AnchorIsDraggedBeyondTheDeflection) {
  JointProperties joint;
  joint.friction_deflection = 0.25;
  const auto anchor = [&](double position) { return dragged(joint, position, 0., {1.}).anchor; };
  EXPECT_EQ(anchor(1.25), 1.);
  EXPECT_EQ(anchor(0.75), 1.);
  EXPECT_EQ(anchor(2.), 1.75);
  EXPECT_EQ(anchor(-1.), -0.75);
}

// Sticks up to 6, slips with 4: at once, or over v_s, where the excess is down to 1/e of 2.
TEST(JointForces, StaticFrictionHoldsAndSlipFalls) {
  JointProperties joint;
  joint.friction = 4.;
  joint.static_excess = 2.;
  joint.friction_deflection = 0.25;
  joint.friction_speed = 1e-3;
  EXPECT_DOUBLE_EQ(dry_friction(joint, 0.125, 0., {}), 3.);
  EXPECT_DOUBLE_EQ(dry_friction(joint, 0.125, 7., {}), 6.);
  EXPECT_FALSE(dragged(joint, 0.25, 7., {}).drags);
  // Dragged more slowly than v_f it still holds all, unless it speeds up.
  const FrictionHook begun = dragged(joint, 0.375, 9e-4, {});
  EXPECT_DOUBLE_EQ(dry_friction(joint, 0.375, 9e-4, begun), 6.);
  EXPECT_DOUBLE_EQ(dry_friction(joint, 0.5, 8e-4, dragged(joint, 0.5, 8e-4, begun)), 6.);
  EXPECT_DOUBLE_EQ(dry_friction(joint, 0.4, 9.1e-4, dragged(joint, 0.4, 9.1e-4, begun)), 4.);
  const FrictionHook slip = dragged(joint, 0.75, 7., {});
  EXPECT_NEAR(slip.anchor, 0.75 - 0.25 * 4. / 6., 1e-15);
  EXPECT_DOUBLE_EQ(dry_friction(joint, 0.75, 7., slip), 4.);
  EXPECT_DOUBLE_EQ(dry_friction(joint, 0.75, 1e-9, slip), 4.);
  // Turned back it sticks, and holds as before.
  const FrictionHook stuck = dragged(joint, 0.75, -1e-9, slip);
  EXPECT_FALSE(stuck.slips);
  EXPECT_EQ(stuck.anchor, slip.anchor);
  EXPECT_DOUBLE_EQ(dry_friction(joint, stuck.anchor - 0.25, 0., stuck), -6.);
  joint.stribeck_velocity = 0.5;
  EXPECT_NEAR(dry_friction(joint, 0.75, 0.5, dragged(joint, 0.75, 0.5, {})), 4. + 2. / std::exp(1.),
              1e-14);
  EXPECT_NEAR(dry_friction(joint, 0.75, 5., dragged(joint, 0.75, 5., {})), 4., 1e-14);
}

// On any path friction takes at least what its spring stores: summed with the torque at the end of
// each step, which for a spring is the larger part of the step's work.
TEST(JointForces, FrictionGivesNothingThatWasNotStored) {
  std::mt19937 random(11);
  std::normal_distribution<double> normal;
  for (int path = 0; path < 200; ++path) {
    JointProperties joint;
    joint.friction = std::exp(normal(random));
    if (path % 3 > 0) joint.static_excess = std::exp(normal(random));
    if (path % 3 > 1) joint.stribeck_velocity = std::exp(normal(random));
    joint.friction_deflection = std::exp(normal(random) - 3.);
    joint.friction_speed = path % 4 == 0 ? 1e9 : std::exp(normal(random));
    const double most = joint.friction + joint.static_excess;
    const double stiffness = most / joint.friction_deflection;
    const double dt = 0.01, reach = std::exp(2. * normal(random)) * joint.friction_deflection;
    double q = normal(random), taken = 0.;
    FrictionHook hook{q};
    for (int i = 0; i < 500; ++i) {
      const double way = reach * normal(random);
      q += way;
      hook = dragged(joint, q, way / dt, hook);
      const double torque = passive_joint_torque(joint, q, way / dt, hook);
      ASSERT_LE(std::abs(torque), most * (1. + 1e-12));
      taken -= torque * way;
      const double stored = 0.5 * stiffness * (q - hook.anchor) * (q - hook.anchor);
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
  EXPECT_DOUBLE_EQ(passive_joint_torque(joint, 0., 9., {0.}), 0.);
  EXPECT_DOUBLE_EQ(passive_joint_torque(joint, 2.125, 0., {0.}), -12.5);
  EXPECT_DOUBLE_EQ(passive_joint_torque(joint, -1.125, 0., {0.}), 12.5);
  EXPECT_DOUBLE_EQ(passive_joint_torque(joint, 2.125, 1., {0.}), -17.5);
  EXPECT_DOUBLE_EQ(passive_joint_torque(joint, -1.125, -1., {0.}), 17.5);
  EXPECT_DOUBLE_EQ(passive_joint_torque(joint, 2.125, -50., {0.}), 0.);
  EXPECT_DOUBLE_EQ(passive_joint_torque(joint, 1.99, 50., {0.}), 0.);
}

}  // namespace
}  // namespace hookpoint::simulation
