// One insect leg of three joints: the coxa turns about the hip's z (up), femur and tibia about two
// parallel horizontal axes.
#pragma once

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

}  // namespace hookpoint::control
