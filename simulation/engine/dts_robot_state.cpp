// What a robot of the DTS engine carries from one step to the next. Everything else follows from it
// by `refresh` or is computed anew in the step.
#include <fmt/format.h>

#include <algorithm>

#include "simulation/engine/dts_robot.h"

namespace hookpoint::simulation {
namespace {

/// The sign that a link's published quaternion has beside the one that follows from its rotation.
double sign_of(const Quaterniond& published, const Quaterniond& computed) {
  const double cosine = published.w * computed.w + published.x * computed.x +
                        published.y * computed.y + published.z * computed.z;
  return cosine < 0. ? -1. : 1.;
}

/// `before` undoes a step that is not yet over; `pending` and what is published follow from
/// `committed`.
template <class Memory, class Archive>
void exchange_memory(Memory& memory, Archive& archive) {
  archive(memory.hook);
  archive(memory.stretch);
  archive(memory.attached);
  archive(memory.sliding);
}

/// Only a ball's memory is remembered with a frame.
template <class Point, class Archive>
void exchange_frame(Point& point, Archive& archive) {
  if (point.radius == 0.) return;
  archive(point.committed_frame.orientation);
  archive(point.committed_frame.normal);
}

}  // namespace

template <class Self, class Archive>
void DtsRobot::exchange(Self& self, Archive& archive) {
  archive(self.state_.base_position);
  archive(self.state_.base_orientation);
  archive(self.state_.base_velocity);
  archive(self.state_.base_angular_velocity);
  for (auto& position : self.state_.joint_positions) archive(position);
  for (auto& rate : self.state_.joint_rates) archive(rate);
  for (const auto& dry : self.dry_joints_) archive(self.anchors_[dry.joint]);
  archive(self.law_step_);
  for (auto& point : self.points_) exchange_memory(point.committed, archive);
  for (auto& point : self.points_) exchange_frame(point, archive);
  for (auto& number : self.bristles_) archive(number);
}

std::size_t DtsRobot::state_size() const {
  StateCount count;
  exchange(*this, count);
  return count.count() + model_.link_count();
}

std::string DtsRobot::state_layout() const {
  const auto balls =
      std::ranges::count_if(points_, [](const ContactPoint& point) { return point.radius > 0.; });
  const std::string frames = balls > 0 ? fmt::format("(orientation[4] normal[3])[{}] ", balls) : "";
  return fmt::format(
      "base_position[3] base_orientation[4] base_velocity[3] base_angular_velocity[3] "
      "joint_position[{0}] joint_rate[{0}] {4}law_step (hook[3] stretch[3] attached sliding)[{1}] "
      "{3}bristle[{2}] quaternion_sign[{0}]",
      model_.link_count(), points_.size(), bristles_.size(), frames,
      dry_joints_.empty() ? "" : fmt::format("friction_anchor[{}] ", dry_joints_.size()));
}

void DtsRobot::save(std::span<double> numbers, std::span<const BodyState> bodies) const {
  StateSaver saver(numbers);
  exchange(*this, saver);
  for (std::size_t i = 1; i < bodies.size(); ++i)
    saver(sign_of(bodies[i].orientation, quaternion_from(workspace_.bodies[i].R_WB)));
}

void DtsRobot::restore(std::span<const double> numbers, std::span<BodyState> bodies) {
  StateRestorer restorer(numbers);
  exchange(*this, restorer);
  std::ranges::fill(passed_, 0);
  std::ranges::fill(ground_impulses_, Vector3d{});  // of the next step again
  refresh();
  for (std::size_t i = 1; i < bodies.size(); ++i) {
    double sign = 1.;
    restorer(sign);
    const Quaterniond q = quaternion_from(workspace_.bodies[i].R_WB);
    bodies[i].orientation = {sign * q.w, sign * q.x, sign * q.y, sign * q.z};
  }
}

void DtsRobot::read_positions(std::span<const double> q) {
  if (model_.mobile()) {
    state_.base_position = {q[0], q[1], q[2]};
    state_.base_orientation = {q[3], q[4], q[5], q[6]};
    q = q.subspan(7);
  }
  std::copy(q.begin(), q.end(), state_.joint_positions.begin());
}

void DtsRobot::write_positions(std::span<double> q) const {
  if (model_.mobile()) {
    const Vector3d& p = state_.base_position;
    const Quaterniond& r = state_.base_orientation;
    const double base[7] = {p.x, p.y, p.z, r.w, r.x, r.y, r.z};
    std::copy(std::begin(base), std::end(base), q.begin());
    q = q.subspan(7);
  }
  std::copy(state_.joint_positions.begin(), state_.joint_positions.end(), q.begin());
}

}  // namespace hookpoint::simulation
