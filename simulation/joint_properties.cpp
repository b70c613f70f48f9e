#include "simulation/joint_properties.h"

namespace hookpoint::simulation {

dts::JointProperties<double> joint_properties(const LinkSpec& link) {
  dts::JointProperties<double> joint;
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
