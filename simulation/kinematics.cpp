#include "simulation/kinematics.h"

namespace hookpoint::simulation {

Pose operator*(const Pose& X_AB, const Pose& X_BC) {
  return {X_AB.position + rotate(X_AB.orientation, X_BC.position),
          X_AB.orientation * X_BC.orientation};
}

Pose joint_pose(const LinkSpec& link) {
  const bool turns = link.joint == JointKind::revolute;
  const double theta = link.theta + (turns ? link.angle : 0.);
  const double d = link.d + (turns ? 0. : link.angle);
  const Pose screw_x{{link.a, 0., 0.}, exponential(Vector3d{link.alpha, 0., 0.})};
  const Pose screw_z{{0., 0., d}, exponential(Vector3d{0., 0., theta})};
  return Pose{link.joint_location, link.joint_orientation} * screw_x * screw_z;
}

std::vector<Pose> body_poses(const RobotSpec& robot) {
  std::vector<Pose> poses{Pose{}};
  for (const ChainSpec& chain : robot.chains) {
    Pose X_BL{chain.hip_distance, chain.hip_orientation};
    for (const LinkSpec& link : chain.links) {
      X_BL = X_BL * joint_pose(link);
      poses.push_back(X_BL);
    }
  }
  return poses;
}

std::vector<const BodySpec*> bodies_of(const RobotSpec& robot) {
  std::vector<const BodySpec*> bodies{&robot.base};
  for (const ChainSpec& chain : robot.chains) {
    for (const LinkSpec& link : chain.links) bodies.push_back(&link.body);
  }
  return bodies;
}

}  // namespace hookpoint::simulation
