#include "reference/robot_tree.h"

namespace hookpoint::reference {
namespace {

using simulation::BodyState;
using simulation::LinkSpec;
using simulation::Pose;

const Vector3d x_axis{1., 0., 0.}, z_axis{0., 0., 1.};

Pose pose_at_zero(const LinkSpec& link) {
  const Pose screw_x{link.a * x_axis, exponential(link.alpha * x_axis)};
  const Pose screw_z{link.d * z_axis, exponential(link.theta * z_axis)};
  return Pose{link.joint_location, link.joint_orientation} * screw_x * screw_z;
}

BodyState initial_base(const simulation::RobotSpec& robot) {
  BodyState state;
  state.position = robot.location;
  state.orientation = robot.orientation;
  if (!robot.mobile) return state;
  state.velocity = robot.velocity;
  state.angular_velocity = robot.angular_velocity;
  return state;
}

}  // namespace

PlaneAxes plane_axes(std::size_t normal) {
  const Vector3d axes[] = {{1., 0., 0.}, {0., 1., 0.}, {0., 0., 1.}};
  const Vector3d &a = axes[(normal + 1) % 3], &b = axes[(normal + 2) % 3], &n = axes[normal];
  return {a, b, n, quaternion_from(Matrix3d{a.x, b.x, n.x, a.y, b.y, n.y, a.z, b.z, n.z})};
}

RobotTree robot_tree(const simulation::Experiment& experiment) {
  RobotTree tree;
  for (std::size_t i = 0; i < experiment.robots.size(); ++i) {
    const simulation::RobotSpec& robot = experiment.robots[i];
    const auto base = static_cast<int>(tree.bodies.size());
    const auto number = static_cast<int>(i);
    tree.bases.push_back(tree.bodies.size());
    tree.bodies.push_back({std::make_shared<simulation::BodySpec>(robot.base),
                           nullptr,
                           number,
                           -1,
                           -1,
                           robot.mobile,
                           {},
                           initial_base(robot),
                           robot.plane_normal});
    simulation::for_each_link(robot, [&](const simulation::TreeLink& at) {
      const auto copy = std::make_shared<LinkSpec>(at.link);
      TreeBody body{std::shared_ptr<const simulation::BodySpec>(copy, &copy->body),
                    copy,
                    number,
                    base + static_cast<int>(at.parent),
                    static_cast<int>(tree.joints++),
                    true,
                    simulation::frame_before(at) * pose_at_zero(at.link),
                    {}};
      body.initial = link_state(tree.bodies[static_cast<std::size_t>(body.parent)].initial, body,
                                at.link.angle, at.link.rate);
      tree.bodies.push_back(body);
    });
  }
  return tree;
}

// w_L = w_P + dq/dt z, v_L = v_P + w_P x p_PL of a turning joint; of a sliding one dq/dt z is added
// to v_L.
BodyState link_state(const BodyState& parent, const TreeBody& link, double angle, double rate) {
  const Pose joint =
      link.turns() ? Pose{{}, exponential(angle * z_axis)} : Pose{angle * z_axis, {}};
  const Pose X_WL = Pose{parent.position, parent.orientation} * link.X_PL0 * joint;
  const Vector3d motion = rate * rotate(X_WL.orientation, z_axis);
  BodyState state;
  state.position = X_WL.position;
  state.orientation = X_WL.orientation;
  state.angular_velocity = parent.angular_velocity;
  state.velocity =
      parent.velocity + cross(parent.angular_velocity, state.position - parent.position);
  (link.turns() ? state.angular_velocity : state.velocity) += motion;
  return state;
}

}  // namespace hookpoint::reference
