#include "reference/ode/joints.h"

#include <cmath>
#include <numbers>

namespace hookpoint::reference {
namespace {

const Vector3d z_axis{0., 0., 1.};

dJointID make_hinge(dWorldID world, dBodyID body, dBodyID parent, const Vector3d& anchor,
                    const Vector3d& axis) {
  const dJointID joint = dJointCreateHinge(world, nullptr);
  dJointAttach(joint, body, parent);
  dJointSetHingeAnchor(joint, anchor.x, anchor.y, anchor.z);
  dJointSetHingeAxis(joint, axis.x, axis.y, axis.z);
  return joint;
}

dJointID make_slider(dWorldID world, dBodyID body, dBodyID parent, const Vector3d& axis) {
  const dJointID joint = dJointCreateSlider(world, nullptr);
  dJointAttach(joint, body, parent);
  dJointSetSliderAxis(joint, axis.x, axis.y, axis.z);
  return joint;
}

/// The angle of `turn` about z, of its many the one nearest to `last` [rad].
double angle_near(const Quaterniond& turn, double last) {
  const double angle = 2. * std::atan2(turn.z, turn.w);
  constexpr double round = 2. * std::numbers::pi;
  return angle + round * std::round((last - angle) / round);
}

}  // namespace

OdeJoints::OdeJoints(const RobotTree& tree, dWorldID world, const std::vector<dBodyID>& bodies) {
  for (std::size_t i = 0; i < tree.bodies.size(); ++i) {
    const TreeBody& body = tree.bodies[i];
    if (body.link == nullptr) continue;
    const auto parent = static_cast<std::size_t>(body.parent);
    const Vector3d axis = rotate(body.initial.orientation, z_axis);
    const dJointID id =
        body.turns() ? make_hinge(world, bodies[i], bodies[parent], body.initial.position, axis)
                     : make_slider(world, bodies[i], bodies[parent], axis);
    joints_.push_back({id, i, parent, body.turns(), body.X_PL0});
  }
}

void OdeJoints::apply(const std::vector<double>& torques) const {
  for (std::size_t i = 0; i < joints_.size(); ++i) {
    if (joints_[i].turns) {
      dJointAddHingeTorque(joints_[i].id, torques[i]);
    } else {
      dJointAddSliderForce(joints_[i].id, torques[i]);
    }
  }
}

// X_PL(q) = X_PL(0) Rot_z(q) or X_PL(0) Trans_z(q), as far as the solver keeps the joint together.
void OdeJoints::read(std::span<const simulation::BodyState> bodies,
                     std::span<simulation::JointState> joints) const {
  for (std::size_t i = 0; i < joints_.size(); ++i) {
    const Joint& joint = joints_[i];
    const simulation::BodyState& link = bodies[joint.body];
    const simulation::BodyState& parent = bodies[joint.parent];
    const Quaterniond R_W0 = parent.orientation * joint.X_PL0.orientation;
    const Vector3d axis = rotate(R_W0, z_axis);
    if (joint.turns) {
      joints[i].angle = angle_near(conjugate(R_W0) * link.orientation, joints[i].angle);
      joints[i].rate = dot(axis, link.angular_velocity - parent.angular_velocity);
      continue;
    }
    const Vector3d arm = link.position - parent.position;
    joints[i].angle = dot(axis, arm - rotate(parent.orientation, joint.X_PL0.position));
    joints[i].rate =
        dot(axis, link.velocity - parent.velocity - cross(parent.angular_velocity, arm));
  }
}

}  // namespace hookpoint::reference
