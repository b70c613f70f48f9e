#include "simulation/experiment/kinematics.h"

namespace hookpoint::simulation {

Pose operator*(const Pose& X_AB, const Pose& X_BC) {
  return {X_AB.position + rotate(X_AB.orientation, X_BC.position),
          X_AB.orientation * X_BC.orientation};
}

Pose inverse(const Pose& X_AB) {
  const Quaterniond back = conjugate(X_AB.orientation);
  return {-rotate(back, X_AB.position), back};
}

Pose joint_pose(const LinkSpec& link) {
  const bool turns = joint_type(link.joint).turns;
  const double theta = link.theta + (turns ? link.angle : 0.);
  const double d = link.d + (turns ? 0. : link.angle);
  const Pose screw_x{{link.a, 0., 0.}, exponential(Vector3d{link.alpha, 0., 0.})};
  const Pose screw_z{{0., 0., d}, exponential(Vector3d{0., 0., theta})};
  return Pose{link.joint_location, link.joint_orientation} * screw_x * screw_z;
}

Pose frame_before(const TreeLink& at) {
  return at.is_first() ? Pose{at.chain.hip_distance, at.chain.hip_orientation} : Pose{};
}

std::vector<Pose> body_poses(const RobotSpec& robot) {
  std::vector<Pose> poses{Pose{}};
  for_each_link(robot, [&](const TreeLink& at) {
    poses.push_back(poses[at.parent] * frame_before(at) * joint_pose(at.link));
  });
  return poses;
}

std::vector<RobotPoint> points_in_base(const RobotSpec& robot) {
  std::vector<RobotPoint> points;
  const std::vector<Pose> poses = body_poses(robot);
  const std::vector<const BodySpec*> bodies = bodies_of(robot);
  for (std::size_t i = 0; i < bodies.size(); ++i) {
    for (std::size_t k = 0; k < bodies[i]->boundary_points.size(); ++k)
      points.push_back(
          {poses[i].position + rotate(poses[i].orientation, bodies[i]->boundary_points[k]), i,
           bodies[i]->boundary_radius(k), bodies[i]->boundary_material(k)});
  }
  return points;
}

}  // namespace hookpoint::simulation
