#include "simulation/experiment/joint_forces.h"

#include <algorithm>
#include <cmath>

namespace hookpoint::simulation {
namespace {

/// Of the stop that the joint is beyond, if it is.
JointSpring stop_spring(const JointProperties& joint, double position) {
  if (position >= joint.lower_limit && position <= joint.upper_limit) return {};
  return {joint.limit_stiffness, joint.limit_damping};
}

}  // namespace

JointSpring moving_spring(const JointProperties& joint, double position) {
  const JointSpring stop = stop_spring(joint, position);
  return {joint.stiffness + stop.stiffness, joint.damping + stop.damping};
}

JointSpring resting_spring(const JointProperties& joint, double position) {
  const JointSpring moving = moving_spring(joint, position);
  return {moving.stiffness + joint.friction / joint.friction_deflection,
          moving.damping + joint.friction / joint.friction_speed};
}

JointSpring friction_spring(const JointProperties& joint, double position, double rate,
                            double anchor) {
  const double z = std::clamp((position - anchor) / joint.friction_deflection, -1., 1.);
  const double load = std::abs(z + rate / joint.friction_speed);
  return {load < 1. ? joint.friction / joint.friction_deflection : 0.,
          joint.friction / (joint.friction_speed * std::max(1., load))};
}

JointProperties joint_properties(const LinkSpec& link) {
  JointProperties joint;
  joint.damping = link.damping;
  joint.friction = link.friction;
  joint.friction_deflection = link.friction_deflection;
  joint.friction_speed = link.friction_speed;
  joint.stiffness = link.stiffness;
  joint.rest_position = link.rest_angle;
  if (link.lower_limit) joint.lower_limit = *link.lower_limit;
  if (link.upper_limit) joint.upper_limit = *link.upper_limit;
  joint.limit_stiffness = link.limit_stiffness;
  joint.limit_damping = link.limit_damping;
  if (link.effort_limit) joint.effort_limit = *link.effort_limit;
  return joint;
}

}  // namespace hookpoint::simulation
