#include "simulation/dts_engine/joint_set.h"

#include <algorithm>
#include <cmath>
#include <numeric>

#include "simulation/experiment/joint_forces.h"
#include "simulation/experiment/robot_tree.h"

namespace hookpoint::simulation {
namespace {

/// Part of the deflection and of the speed by which an event of dry friction is beyond the change
/// that it marks: above the rounding of positions.
constexpr double beyond = 1e-9;

}  // namespace

JointSet::JointSet(const RobotSpec& robot) {
  for_each_link(robot, [&](const TreeLink& at) {
    const JointProperties& joint = properties_.emplace_back(joint_properties(at.link));
    if (joint.friction + joint.static_excess > 0.) dry_joints_.push_back({.joint = at.joint()});
    hooks_.push_back({at.link.angle});
  });
  hooks_before_ = hooks_;
}

void JointSet::torques(std::span<const double> drive, std::span<const double> positions,
                       std::span<const double> rates, std::span<double> torques) const {
  for (std::size_t i = 0; i < properties_.size(); ++i) {
    const JointProperties& joint = properties_[i];
    torques[i] = drive_torque(joint, drive[i]) +
                 passive_joint_torque(joint, positions[i], rates[i], hooks_[i]);
  }
}

// tau(q + h v1, v1) = tau(q, v) - h k v - (h^2 k + h c) a with v1 = v + h a.
void JointSet::torques_at_end_of(double h, std::span<const double> drive,
                                 std::span<const double> positions, std::span<const double> rates,
                                 std::span<double> torques, std::span<double> inertias) const {
  this->torques(drive, positions, rates, torques);
  std::ranges::fill(inertias, 0.);
  const auto move = [&](std::size_t i, const JointSpring& spring) {
    torques[i] -= h * spring.stiffness * rates[i];
    inertias[i] += h * (h * spring.stiffness + spring.damping);
  };
  for (std::size_t i = 0; i < properties_.size(); ++i)
    move(i, moving_spring(properties_[i], positions[i]));
  for (const auto& [i, bound] : dry_joints_) {
    if (bound)
      torques[i] += dry_friction(properties_[i], positions[i], rates[i], hooks_[i]) - *bound;
    else
      move(i, friction_spring(properties_[i], positions[i], rates[i], hooks_[i]));
  }
}

bool JointSet::bind_friction(double h, std::span<const double> positions,
                             std::span<const double> rates, std::span<const double> accelerations) {
  bool any = false;
  for (auto& [i, bound] : dry_joints_) {
    if (bound) continue;
    const JointProperties& joint = properties_[i];
    const auto [k, c] = friction_spring(joint, positions[i], rates[i], hooks_[i]);
    const double friction = dry_friction(joint, positions[i], rates[i], hooks_[i]) +
                            h * k * rates[i] + h * (h * k + c) * accelerations[i];
    const double most =
        (joint.friction + joint.static_excess) * friction_part(joint, rates[i], hooks_[i]);
    if (std::abs(friction) <= most) continue;
    bound = std::copysign(most, friction);
    any = true;
  }
  return any;
}

void JointSet::unbind_friction() {
  for (DryJoint& dry : dry_joints_) dry.bound.reset();
}

void JointSet::commit(std::span<const double> positions, std::span<const double> rates) {
  for (const DryJoint& dry : dry_joints_) {
    const std::size_t i = dry.joint;
    hooks_[i] = dragged(properties_[i], positions[i], rates[i], hooks_[i]);
  }
}

std::size_t JointSet::event_count() const {
  const auto limits = [](std::size_t sum, const JointProperties& joint) {
    return sum + std::isfinite(joint.lower_limit) + std::isfinite(joint.upper_limit);
  };
  return std::accumulate(properties_.begin(), properties_.end(), dry_joints_.size(), limits);
}

void JointSet::event_values(std::span<const double> positions, std::span<const double> rates,
                            std::span<double> values) const {
  auto value = values.begin();
  for (std::size_t i = 0; i < properties_.size(); ++i) {
    const JointProperties& joint = properties_[i];
    if (std::isfinite(joint.lower_limit)) *value++ = positions[i] - joint.lower_limit;
    if (std::isfinite(joint.upper_limit)) *value++ = joint.upper_limit - positions[i];
  }
  for (const DryJoint& dry : dry_joints_) {
    const JointProperties& joint = properties_[dry.joint];
    const double stretch = positions[dry.joint] - hooks_[dry.joint].anchor;
    *value++ = hooks_[dry.joint].drags
                   ? std::copysign(1., stretch) * rates[dry.joint] + beyond * joint.friction_speed
                   : (1. + beyond) * joint.friction_deflection - std::abs(stretch);
  }
}

}  // namespace hookpoint::simulation
