// What a robot tells adaptive integrators: when its contact memory is committed, where its
// accelerations jump, and which part of them is stiff.
#include <algorithm>
#include <cmath>
#include <limits>
#include <numeric>

#include "dts/configuration.h"
#include "dts/external_forces.h"
#include "dts/forward_kinematics.h"
#include "simulation/engine/dts_robot.h"

namespace hookpoint::simulation {

namespace {

/// Width of the surface to either side [m]: above the rounding of positions, far below any depth
/// that matters.
constexpr double surface = 1e-11;
/// The same of dry friction: part of the deflection and of the speed by which an event is beyond
/// the change that it marks.
constexpr double beyond = 1e-9;

}  // namespace

double ContactPoint::depth_on_side(double depth_now, double reach) const {
  const double within = depth_now + reach;
  return (inside ? std::max(within, std::numeric_limits<double>::min()) : std::min(within, 0.)) -
         reach;
}

double ContactPoint::side_event(double depth_now, double reach) const {
  return depth_now + reach + (inside ? surface : -surface);
}

// Kinematics and contact alone: the motion is the integrator's.
void DtsRobot::weigh_at(double weight, std::span<const double> q, std::span<const double> v) {
  read_state(q, v);
  dts::forward_kinematics(model_, state_, workspace_);
  dts::clear_external_forces(workspace_);
  apply_contact_forces(true);
  for (std::size_t body = 0; body < ground_forces_.size(); ++body)
    ground_impulses_[body] += weight * ground_forces_[body];
}

void DtsRobot::commit(double /*time*/, double /*dt*/, std::span<const double> q,
                      std::span<const double> v) {
  if (points_.empty() && dry_joints_.empty()) return;
  settle_at(q, v);
  for (ContactPoint& point : points_) point.commit();
  commit_anchors();
}

void DtsRobot::cross_events(std::span<const int> directions) {
  for (std::size_t i = 0; i < points_.size(); ++i) {
    ContactPoint& point = points_[i];
    const int direction = directions[2 * i + 1];
    if (direction == 0 || !point.committed.attached) continue;
    const auto& material = experiment_->materials[point.material].constants;
    point.committed.sliding = contact::slides_after(law_, direction < 0, point.committed, material);
  }
}

// What the law let go of when the event's state was committed.
void DtsRobot::begin_anew(std::span<double> v) {
  std::ranges::copy(next_bristles_, v.last(next_bristles_.size()).begin());
}

std::size_t DtsRobot::event_count() const {
  const auto limits = [](std::size_t sum, const dts::JointProperties<double>& joint) {
    return sum + std::isfinite(joint.lower_limit) + std::isfinite(joint.upper_limit);
  };
  return std::accumulate(joints_.begin(), joints_.end(), 2 * points_.size() + dry_joints_.size(),
                         limits);
}

void DtsRobot::event_values(double /*time*/, std::span<const double> q, std::span<const double> v,
                            std::span<double> values) {
  read_state(q, v);
  dts::forward_kinematics(model_, state_, workspace_);
  auto value = values.begin();
  for (std::size_t i = 0; i < points_.size(); ++i) {
    const ContactPoint& point = points_[i];
    const TouchingPlace touching = touching_place(point, workspace_.bodies[point.body], *ground_);
    const auto& material = experiment_->materials[touching.tile.material].constants;
    const double reach = contact::reach(law_, material);
    *value++ = point.side_event(touching.tile.depth, reach);
    const contact::PointKinematics<double> kinematics{
        touching.position, touching.velocity, touching.tile.normal,
        point.depth_on_side(touching.tile.depth, reach), bristle_at(bristles_, i)};
    *value++ = point.committed.attached
                   ? contact::switching_value(law_, kinematics, point.committed, material)
                   : 1.;
  }
  for (std::size_t i = 0; i < joints_.size(); ++i) {
    const double angle = state_.joint_positions[i];
    if (std::isfinite(joints_[i].lower_limit)) *value++ = angle - joints_[i].lower_limit;
    if (std::isfinite(joints_[i].upper_limit)) *value++ = joints_[i].upper_limit - angle;
  }
  for (const DryJoint& dry : dry_joints_) {
    const dts::JointProperties<double>& joint = joints_[dry.joint];
    const double stretch = state_.joint_positions[dry.joint] - anchors_[dry.joint];
    *value++ = dry.slips ? std::copysign(1., stretch) * state_.joint_rates[dry.joint] +
                               beyond * joint.friction_speed
                         : (1. + beyond) * joint.friction_deflection - std::abs(stretch);
  }
}

integrators::Status DtsRobot::split_accelerations(double /*time*/, std::span<const double> q,
                                                  std::span<const double> v,
                                                  std::span<double> a_free,
                                                  std::span<double> a_contact) {
  read_state(q, v);
  dts::forward_kinematics(model_, state_, workspace_);
  apply_external_forces();
  std::ranges::fill(bristle_rates_, 0.);
  accelerate();
  std::ranges::copy(a_, a_free.begin());
  // The whole comes last: it is what is published.
  apply_contact_forces(true);
  accelerate();
  for (std::size_t i = 0; i < a_.size(); ++i) a_contact[i] = a_[i] - a_free[i];
  return integrators::all_finite(a_free) && integrators::all_finite(a_contact)
             ? integrators::Status::ok
             : integrators::Status::not_finite;
}

// tangent_rate is singular at 2 pi, where a rotation vector has gone round.
bool DtsRobot::far(std::span<const double> u) const {
  return model_.mobile() && norm(Vector3d{u[0], u[1], u[2]}) > 2.;
}

std::size_t DtsRobot::moving_size() const { return dts::velocity_count(model_); }

bool DtsRobot::evolves(std::size_t i) const {
  return points_[(i - moving_size()) / bristle_states_].inside;
}

// A base that cannot move keeps its chains from feeling each other.
std::size_t DtsRobot::group_size() const {
  if (model_.mobile()) return moving_size();
  std::size_t longest = 1;
  for (const ChainSpec& chain : experiment_->robots[index_].chains)
    longest = std::max(longest, chain.links.size());
  return longest;
}

}  // namespace hookpoint::simulation
