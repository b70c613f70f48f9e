#include "simulation/engine/joint_set.h"

#include <algorithm>
#include <cmath>
#include <numeric>

#include "simulation/joint_properties.h"
#include "simulation/robot_tree.h"

namespace hookpoint::simulation {
namespace {

/// Part of the deflection and of the speed by which an event of dry friction is beyond the change
/// that it marks: above the rounding of positions.
constexpr double beyond = 1e-9;

}  // namespace

JointSet::JointSet(const RobotSpec& robot) {
  for_each_link(robot, [&](const TreeLink& at) {
    if (at.link.friction > 0.) dry_joints_.push_back({at.joint()});
    properties_.push_back(joint_properties(at.link));
    anchors_.push_back(at.link.angle);
  });
  anchors_before_ = anchors_;
}

void JointSet::torques(std::span<const double> drive, std::span<const double> positions,
                       std::span<const double> rates, std::span<double> torques) const {
  for (std::size_t i = 0; i < properties_.size(); ++i) {
    const dts::JointProperties<double>& joint = properties_[i];
    torques[i] = dts::drive_torque(joint, drive[i]) +
                 dts::passive_joint_torque(joint, positions[i], rates[i], anchors_[i]);
  }
}

void JointSet::commit(std::span<const double> positions, std::span<const double> rates) {
  for (DryJoint& dry : dry_joints_) {
    const std::size_t i = dry.joint;
    const double before = anchors_[i];
    anchors_[i] = dts::dragged_anchor(properties_[i], positions[i], before);
    const double stretch = positions[i] - anchors_[i];
    dry.slips = anchors_[i] != before && stretch * rates[i] > 0.;
  }
}

std::size_t JointSet::event_count() const {
  const auto limits = [](std::size_t sum, const dts::JointProperties<double>& joint) {
    return sum + std::isfinite(joint.lower_limit) + std::isfinite(joint.upper_limit);
  };
  return std::accumulate(properties_.begin(), properties_.end(), dry_joints_.size(), limits);
}

void JointSet::event_values(std::span<const double> positions, std::span<const double> rates,
                            std::span<double> values) const {
  auto value = values.begin();
  for (std::size_t i = 0; i < properties_.size(); ++i) {
    const dts::JointProperties<double>& joint = properties_[i];
    if (std::isfinite(joint.lower_limit)) *value++ = positions[i] - joint.lower_limit;
    if (std::isfinite(joint.upper_limit)) *value++ = joint.upper_limit - positions[i];
  }
  for (const DryJoint& dry : dry_joints_) {
    const dts::JointProperties<double>& joint = properties_[dry.joint];
    const double stretch = positions[dry.joint] - anchors_[dry.joint];
    *value++ = dry.slips
                   ? std::copysign(1., stretch) * rates[dry.joint] + beyond * joint.friction_speed
                   : (1. + beyond) * joint.friction_deflection - std::abs(stretch);
  }
}

}  // namespace hookpoint::simulation
