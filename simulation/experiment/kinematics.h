// Where the bodies of a robot stand at its initial joint angles, relative to its base.
#pragma once

#include <vector>

#include "simulation/experiment/robot_tree.h"

namespace hookpoint::simulation {

/// A frame B in a frame A.
struct Pose {
  Vector3d position;        ///< p_AB [m]
  Quaterniond orientation;  ///< R_AB
};

/// X_AC = X_AB X_BC.
Pose operator*(const Pose& X_AB, const Pose& X_BC);
/// X_BA.
Pose inverse(const Pose& X_AB);

/// The link's frame in the one before it, at its initial joint angle: its fixed transform, then
/// Rot_x(alpha) Trans_x(a) Rot_z(theta) Trans_z(d).
Pose joint_pose(const LinkSpec& link);

/// X_PH, from which the link's own pose counts: the hip of a chain's first link in the body that
/// carries the chain, the preceding link itself for the others.
Pose frame_before(const TreeLink& at);

/// X_BL of every body in the base's frame, in the order of robot_tree.h. O(bodies).
std::vector<Pose> body_poses(const RobotSpec& robot);

/// A boundary point.
struct RobotPoint {
  Vector3d p_BP;         ///< base axes [m]
  std::size_t body = 0;  ///< in the order of robot_tree.h
  double radius = 0.;    ///< [m]
  int material = no_material;
};
/// All of a robot, body by body. O(bodies + points).
std::vector<RobotPoint> points_in_base(const RobotSpec& robot);

}  // namespace hookpoint::simulation
