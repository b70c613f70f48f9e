// Bodies too far above the ground for any of their boundary points to feel it: they are passed
// over, and nothing that is published differs but by the time that it takes.
#include <algorithm>
#include <cmath>

#include "simulation/engine/dts_robot.h"

namespace hookpoint::simulation {
namespace {

constexpr double rounding = 1e-9;      // [m], of a box's depth
constexpr int commits_remembered = 2;  // `committed` and `before`

PointsBox box_about(std::span<const ContactPoint> points) {
  Vector3d low = points.front().p_BP, high = low;
  for (const ContactPoint& point : points) {
    const Vector3d& p = point.p_BP;
    low = {std::min(low.x, p.x), std::min(low.y, p.y), std::min(low.z, p.z)};
    high = {std::max(high.x, p.x), std::max(high.y, p.y), std::max(high.z, p.z)};
  }
  return {0.5 * (low + high), 0.5 * (high - low)};
}

}  // namespace

// Not of events, bristles and balls, which go on in the air, nor of points that are published.
void DtsRobot::bound_points() {
  if (adaptive_ || bristle_states_ > 0) return;
  for (const MaterialSpec& material : experiment_->materials) {
    const auto reach = [&](const auto& law) { return double(law.reach(material.constants)); };
    reach_ = std::max(reach_, std::visit(reach, law_));
  }
  for (std::size_t body = 0; body < boxes_.size(); ++body) {
    const auto published = [&](const PointSpec& point) {
      return point.robot == index_ && static_cast<std::size_t>(point.body) == body;
    };
    const auto points = std::span<const ContactPoint>(points_).subspan(
        first_points_[body], first_points_[body + 1] - first_points_[body]);
    const auto is_ball = [](const ContactPoint& point) { return point.radius > 0.; };
    if (points.empty() || std::ranges::any_of(points, is_ball) ||
        std::ranges::any_of(experiment_->points, published))
      continue;
    boxes_[body] = box_about(points);
  }
}

void DtsRobot::add_ground_forces(std::size_t first_body, std::vector<GroundForce>& forces) const {
  for (const ContactPoint& point : points_) {
    if (passed_[point.body] > 0 || dot(point.force, point.force) == 0.) continue;
    const dts::BodyMotion<double>& body = workspace_.bodies[point.body];
    forces.push_back({first_body + point.body,
                      transpose_times(body.R_WB, point.position - body.p_WB), point.force});
  }
}

bool DtsRobot::passed_over(std::size_t body, bool trial) {
  const PointsBox& box = boxes_[body];
  const dts::BodyMotion<double>& motion = workspace_.bodies[body];
  const bool above =
      std::isfinite(box.half.x) && ground_->deepest(motion.p_WB + motion.R_WB * box.center,
                                                    motion.R_WB, box.half) < -reach_ - rounding;
  if (trial) return above;
  if (above && passed_[body] == 0) {
    for (std::size_t i = first_points_[body]; i < first_points_[body + 1]; ++i) {
      points_[i].pending = {};
      points_[i].force = {};
      points_[i].inside = false;
    }
  }
  passed_[body] = above ? std::max(passed_[body], 1) : 0;
  return above;
}

// The step from the refreshed state is taken. Where a body has been passed over for as many steps
// as are remembered, all memories are the same.
void DtsRobot::commit_points() {
  for (std::size_t body = 0; body < passed_.size(); ++body) {
    if (passed_[body] > commits_remembered) continue;
    if (passed_[body] > 0) ++passed_[body];
    for (std::size_t i = first_points_[body]; i < first_points_[body + 1]; ++i) {
      ContactPoint& point = points_[i];
      point.before = point.committed;
      if (point.radius > 0.) point.before_frame = point.committed_frame;
      point.commit();
    }
  }
}

}  // namespace hookpoint::simulation
