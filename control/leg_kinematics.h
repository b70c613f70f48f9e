// Legs of two and three joints, their feet and joint angles in closed form. An insect's coxa turns
// about the hip's z (up), its femur and tibia about two parallel horizontal axes. A mammal's hip swings
// the leg sideways about the hip's z (forward), its thigh and shank swing it backwards about two axes
// parallel to the hip's y (left); the hip's x is down.
#pragma once

#include <array>

#include "math/vector3.h"

namespace hookpoint::control {

/// Distances between successive joint axes, the last to the foot [m]; modified Denavit-Hartenberg a
/// = coxa with alpha = 90 deg before the femur, a = femur with alpha = 0 before the tibia, foot at
/// x = tibia of the last link.
struct LegLengths {
  double coxa, femur, tibia;
};

/// Joint angles [rad]; all zero is the leg stretched along the hip's x, positive femur and tibia
/// angles raise the foot.
struct LegAngles {
  double coxa, femur, tibia;
};

/// On which side of the line from femur joint to foot the knee is: `up` is the insect's (tibia
/// angle <= 0).
enum class Knee { up, down };

struct LegSolution {
  LegAngles angles;
  bool reachable;  ///< false: the angles are those of the nearest point along the line from the
                   ///< femur joint
};

/// Femur and tibia in their plane.
struct ShankAngles {
  double femur, tibia;
  bool reachable;  ///< as of a LegSolution
};

/// Angles [rad] of femur and tibia that put the foot `outwards` and `up` from the femur's axis [m]:
/// the two-link triangle of `leg_angles`.
ShankAngles shank_angles(double femur, double tibia, double outwards, double up, Knee knee);

/// Foot position p_HF, hip axes [m], of joint angles [rad].
Vector3d foot_position(const LegLengths& lengths, const LegAngles& angles);

/// Joint angles [rad] that put the foot at `p_HF` (hip axes, m), the leg turned towards it (never
/// folded over the hip axis). Two-link triangle in the leg's plane: Craig, Introduction to Robotics
/// (2005), 4.4; the sine of the knee by Heron's product, which keeps its digits where the leg is
/// nearly stretched.
LegSolution leg_angles(const LegLengths& lengths, const Vector3d& p_HF, Knee knee);

enum class LegKind {
  insect,
  mammal,  ///< hip, thigh and shank; modified Denavit-Hartenberg alpha = -90 deg and d = hip_offset
           ///< before the thigh, a = thigh before the shank; positive thigh and shank angles swing
           ///< the foot backwards
  planar   ///< two links in the hip's plane of x and z, positive angles from x to z
};

/// A leg of any kind. Femur and tibia are thigh and shank of a mammal.
struct Leg {
  LegKind kind = LegKind::insect;
  LegLengths lengths{};    ///< the coxa's is the insect's [m]
  double hip_offset = 0.;  ///< the mammal's: from its hip axis to the plane of thigh and shank [m]
  Knee knee = Knee::up;  ///< of mammals and planar legs `down` is a shank angle >= 0: knee forward
};

/// From the hip: coxa, femur, tibia, or hip, thigh, shank; of planar legs the first is 0 [rad].
using JointAngles = std::array<double, 3>;

/// Foot position p_HF, hip axes [m].
Vector3d foot_position(const Leg& leg, const JointAngles& angles);

struct LegGoal {
  JointAngles angles;
  bool reachable;  ///< as of a LegSolution; a mammal's foot is also out of reach nearer to the hip
                   ///< axis than its offset
};

/// Joint angles [rad] that put the foot at `p_HF` (hip axes, m), below the mammal's hip. The foot of
/// a planar leg has no y.
LegGoal joint_angles(const Leg& leg, const Vector3d& p_HF);

}  // namespace hookpoint::control
