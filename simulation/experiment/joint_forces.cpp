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
  const double most = joint.friction + joint.static_excess;
  return {moving.stiffness + most / joint.friction_deflection,
          moving.damping + most / joint.friction_speed};
}

FrictionHook dragged(const JointProperties& joint, double position, double rate,
                     const FrictionHook& hook) {
  const auto anchor_of = [&](const FrictionHook& now) {
    const double z = position - hook.anchor;
    const double most = joint.friction_deflection * friction_part(joint, rate, now);
    return select(z > most, position - most, select(z < -most, position + most, hook.anchor));
  };
  FrictionHook next{anchor_of(hook), rate};
  // The hook of a joint that slows down stays behind while friction rises again.
  const bool moves = next.anchor != hook.anchor || (hook.slips && joint.static_excess > 0.);
  if (!moves || !((position - next.anchor) * rate > 0.)) return next;
  next.drags = true;
  const bool speeds_up = hook.drags && std::abs(rate) > std::abs(hook.rate);
  next.slips = hook.slips || speeds_up || std::abs(rate) > joint.friction_speed;
  next.anchor = anchor_of(next);
  return next;
}

JointSpring friction_spring(const JointProperties& joint, double position, double rate,
                            const FrictionHook& hook) {
  const double part = friction_part(joint, rate, hook);
  const double most = joint.friction + joint.static_excess;
  if (part <= 0.) return {};
  const double z = std::clamp((position - hook.anchor) / joint.friction_deflection, -part, part);
  const double load = std::abs(z + rate / joint.friction_speed) / part;
  return {load < 1. ? most / joint.friction_deflection : 0.,
          most / (joint.friction_speed * std::max(1., load))};
}

JointProperties joint_properties(const LinkSpec& link) {
  JointProperties joint;
  joint.damping = link.damping;
  joint.friction = link.friction;
  if (link.static_friction) joint.static_excess = *link.static_friction - link.friction;
  joint.stribeck_velocity = link.stribeck_velocity;
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
