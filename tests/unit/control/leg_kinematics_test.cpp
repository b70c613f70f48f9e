// Inverse against forward kinematics, and the forward against the product of the MDH transforms.
#include "control/leg_kinematics.h"

#include <gtest/gtest.h>

#include <cmath>
#include <numbers>
#include <random>

#include "math/rotation.h"

namespace hookpoint::control {
namespace {

constexpr double pi = std::numbers::pi;
constexpr LegLengths lengths{0.05, 0.1, 0.15};

/// Rot_x(alpha) Trans_x(a) Rot_z(theta) link by link, the foot at x = tibia of the last frame.
Vector3d product_of_transforms(const LegLengths& leg, const LegAngles& q) {
  const auto link = [](double alpha, double a, double theta, const Vector3d& p) {
    const Vector3d turned = rotate(exponential(Vector3d{0., 0., theta}), p);
    return rotate(exponential(Vector3d{alpha, 0., 0.}), Vector3d{a, 0., 0.} + turned);
  };
  return link(0., 0., q.coxa,
              link(pi / 2., leg.coxa, q.femur, link(0., leg.femur, q.tibia, {leg.tibia, 0., 0.})));
}

TEST(LegKinematics, ForwardIsTheProductOfTheMdhTransforms) {
  std::mt19937 random(1);
  std::uniform_real_distribution<double> angle(-pi, pi);
  for (int i = 0; i < 1000; ++i) {
    const LegAngles q{angle(random), angle(random), angle(random)};
    EXPECT_LT(norm(foot_position(lengths, q) - product_of_transforms(lengths, q)), 1e-15);
  }
}

TEST(LegKinematics, AnglesReachTheirTarget) {
  std::mt19937 random(2);
  std::uniform_real_distribution<double> unit(0., 1.);
  for (int i = 0; i < 10000; ++i) {
    const LegLengths leg{0.1 * unit(random), 0.05 + unit(random), 0.05 + unit(random)};
    // A point of the annulus that femur and tibia reach, before the femur's axis.
    const double shortest = std::abs(leg.femur - leg.tibia), longest = leg.femur + leg.tibia;
    const double distance = shortest + (longest - shortest) * unit(random);
    const double elevation = pi * (unit(random) - 0.5), yaw = 2. * pi * (unit(random) - 0.5);
    const double outwards = leg.coxa + distance * std::cos(elevation);
    const Vector3d target{outwards * std::cos(yaw), outwards * std::sin(yaw),
                          distance * std::sin(elevation)};
    for (const Knee knee : {Knee::up, Knee::down}) {
      const LegSolution solution = leg_angles(leg, target, knee);
      EXPECT_LT(norm(foot_position(leg, solution.angles) - target), 1e-12);
      EXPECT_EQ(knee == Knee::up, solution.angles.tibia <= 0.);
    }
  }
}

TEST(LegKinematics, AnglesComeBack) {
  std::mt19937 random(3);
  std::uniform_real_distribution<double> coxa(-3., 3.), femur(-0.5, 0.7), tibia(0.3, 2.4);
  for (int i = 0; i < 10000; ++i) {
    for (const double side : {-1., 1.}) {
      const LegAngles q{coxa(random), femur(random), side * tibia(random)};
      const Vector3d foot = foot_position(lengths, q);
      // Folded over the hip's axis the same foot has another answer, the leg turned round.
      if (lengths.coxa + lengths.femur * std::cos(q.femur) +
              lengths.tibia * std::cos(q.femur + q.tibia) <
          0.01)
        continue;
      const LegSolution solution = leg_angles(lengths, foot, side < 0. ? Knee::up : Knee::down);
      EXPECT_TRUE(solution.reachable);
      EXPECT_NEAR(solution.angles.coxa, q.coxa, 1e-12);
      EXPECT_NEAR(solution.angles.femur, q.femur, 1e-12);
      EXPECT_NEAR(solution.angles.tibia, q.tibia, 1e-12);
    }
  }
}

TEST(LegKinematics, OutOfReachIsTheNearestPointAlongTheLine) {
  // Too far, straight out: stretched, 0.3 m from the hip.
  const LegSolution far = leg_angles(lengths, {0.5, 0., 0.}, Knee::up);
  EXPECT_FALSE(far.reachable);
  EXPECT_LT(norm(foot_position(lengths, far.angles) - Vector3d{0.3, 0., 0.}), 1e-12);
  // Too far, down at 45 degrees from the femur's axis at x = 0.05.
  const LegSolution down = leg_angles(lengths, {0.05 + 1., 0., -1.}, Knee::up);
  EXPECT_FALSE(down.reachable);
  const double share = 0.25 / std::sqrt(2.);
  EXPECT_LT(norm(foot_position(lengths, down.angles) - Vector3d{0.05 + share, 0., -share}), 1e-12);
  // Too near: tibia folded back on the femur, 0.05 m below its axis.
  const LegSolution near = leg_angles(lengths, {0.05, 0., -0.01}, Knee::up);
  EXPECT_FALSE(near.reachable);
  EXPECT_LT(norm(foot_position(lengths, near.angles) - Vector3d{0.05, 0., -0.05}), 1e-12);
}

TEST(LegKinematics, AnInsectStandsKneeUp) {
  // configs/robots/leg.hook at its initial angles: foot 0.05 + 0.1 cos 30 deg out, tibia upright.
  const Vector3d foot{0.05 + 0.1 * std::sqrt(3.) / 2., 0., 0.1 * 0.5 - 0.15};
  const LegAngles q = leg_angles(lengths, foot, Knee::up).angles;
  EXPECT_NEAR(q.coxa, 0., 1e-14);
  EXPECT_NEAR(q.femur, pi / 6., 1e-14);
  EXPECT_NEAR(q.tibia, -2. * pi / 3., 1e-14);
}

/// Rot_x(-90 deg) before the thigh, the hip's offset along its axis.
Vector3d mammal_product_of_transforms(const Leg& leg, const JointAngles& q) {
  const auto link = [](double alpha, double a, double d, double theta, const Vector3d& p) {
    const Vector3d turned = rotate(exponential(Vector3d{0., 0., theta}), p);
    return rotate(exponential(Vector3d{alpha, 0., 0.}), Vector3d{a, 0., d} + turned);
  };
  return link(0., 0., 0., q[0],
              link(-pi / 2., 0., leg.hip_offset, q[1],
                   link(0., leg.lengths.femur, 0., q[2], {leg.lengths.tibia, 0., 0.})));
}

Leg mammal(double offset, Knee knee) { return {LegKind::mammal, {0., 0.2, 0.25}, offset, knee}; }

TEST(LegKinematics, AMammalIsTheProductOfTheMdhTransforms) {
  std::mt19937 random(4);
  std::uniform_real_distribution<double> angle(-pi, pi);
  const Leg leg = mammal(-0.08, Knee::down);
  for (int i = 0; i < 1000; ++i) {
    const JointAngles q{angle(random), angle(random), angle(random)};
    EXPECT_LT(norm(foot_position(leg, q) - mammal_product_of_transforms(leg, q)), 1e-15);
  }
}

TEST(LegKinematics, AMammalStandsKneeBackOrForward) {
  // Thigh and shank 0.2 m, bent by 60 deg each from the plumb line: the foot 0.2 m below the hip.
  for (const Knee knee : {Knee::up, Knee::down}) {
    const double bend = knee == Knee::down ? pi / 3. : -pi / 3.;
    const Leg leg{LegKind::mammal, {0., 0.2, 0.2}, 0.08, knee};
    const LegGoal goal = joint_angles(leg, {0.2, 0.08, 0.});
    EXPECT_NEAR(goal.angles[0], 0., 1e-14);
    EXPECT_NEAR(goal.angles[1], -bend, 1e-14);
    EXPECT_NEAR(goal.angles[2], 2. * bend, 1e-14);
    // A thigh at a negative angle is in front of the hip: z is forward.
    const Vector3d knee_at =
        foot_position({LegKind::mammal, {0., 0.2, 1e-12}, 0.08, knee}, {0., goal.angles[1], 0.});
    EXPECT_EQ(knee_at.z > 0., knee == Knee::down);
  }
}

TEST(LegKinematics, AnglesOfAMammalComeBack) {
  std::mt19937 random(5);
  std::uniform_real_distribution<double> hip(-1., 1.), thigh(-0.8, 0.8), shank(0.3, 1.2);
  for (int i = 0; i < 10000; ++i) {
    for (const double fold : {-1., 1.}) {
      const Leg leg = mammal(0.1 * hip(random), fold < 0. ? Knee::up : Knee::down);
      const JointAngles q{hip(random), thigh(random), fold * shank(random)};
      // Below the hip: above it the same foot has another answer.
      if (0.2 * std::cos(q[1]) + 0.25 * std::cos(q[1] + q[2]) < 0.01) continue;
      const LegGoal goal = joint_angles(leg, foot_position(leg, q));
      EXPECT_TRUE(goal.reachable);
      for (std::size_t joint = 0; joint < q.size(); ++joint)
        EXPECT_NEAR(goal.angles[joint], q[joint], 1e-11);
    }
  }
}

TEST(LegKinematics, AMammalFootNearerThanItsOffsetIsOutOfReach) {
  const Leg leg = mammal(0.08, Knee::down);
  EXPECT_TRUE(joint_angles(leg, {0.081, 0., 0.3}).reachable);
  EXPECT_FALSE(joint_angles(leg, {0.079, 0., 0.3}).reachable);
  EXPECT_FALSE(joint_angles(leg, {0.6, 0.08, 0.}).reachable);
}

TEST(LegKinematics, APlanarLegStaysInItsPlane) {
  const Leg leg{LegKind::planar, {0., 0.2, 0.25}, 0., Knee::up};
  const LegGoal goal = joint_angles(leg, {0.3, 0., 0.2});
  EXPECT_TRUE(goal.reachable);
  EXPECT_EQ(goal.angles[0], 0.);
  EXPECT_LE(goal.angles[2], 0.);
  EXPECT_LT(norm(foot_position(leg, goal.angles) - Vector3d{0.3, 0., 0.2}), 1e-15);
}

}  // namespace
}  // namespace hookpoint::control
