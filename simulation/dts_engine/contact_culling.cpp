#include "simulation/dts_engine/contact_culling.h"

#include <algorithm>
#include <cmath>

namespace hookpoint::simulation {
namespace {

constexpr double box_rounding = 1e-9;  // [m], of a box's depth
constexpr int commits_remembered = 2;  // ContactPoint::committed and ContactPoint::before

}  // namespace

void ContactCulling::allow(std::size_t body, std::span<const ContactPoint> points, double reach) {
  Vector3d low = points.front().p_BP, high = low;
  for (const ContactPoint& point : points) {
    const Vector3d& p = point.p_BP;
    low = {std::min(low.x, p.x), std::min(low.y, p.y), std::min(low.z, p.z)};
    high = {std::max(high.x, p.x), std::max(high.y, p.y), std::max(high.z, p.z)};
  }
  boxes_[body] = {0.5 * (low + high), 0.5 * (high - low), reach};
}

bool ContactCulling::is_above(std::size_t body, const dts::BodyMotion<double>& motion,
                              const contact::Terrain& ground) const {
  const PointsBox& box = boxes_[body];
  return std::isfinite(box.half.x) &&
         ground.deepest(motion.p_WB + motion.R_WB * box.center, motion.R_WB, box.half) <
             -box.reach - box_rounding;
}

bool ContactCulling::accept(std::size_t body, bool above) {
  const bool begins = above && culled_[body] == 0;
  culled_[body] = above ? std::max(culled_[body], 1) : 0;
  return begins;
}

bool ContactCulling::commits(std::size_t body) {
  if (culled_[body] > commits_remembered) return false;
  if (culled_[body] > 0) ++culled_[body];
  return true;
}

void ContactCulling::forget() { std::ranges::fill(culled_, 0); }

bool may_be_culled(const Experiment& experiment, std::size_t robot, std::size_t body,
                   std::span<const ContactPoint> points) {
  const auto is_ball = [](const ContactPoint& point) { return point.radius > 0.; };
  const auto published = [&](const PointSpec& point) {
    return point.robot == static_cast<int>(robot) && static_cast<std::size_t>(point.body) == body;
  };
  return !points.empty() && std::ranges::none_of(points, is_ball) &&
         std::ranges::none_of(experiment.points, published);
}

}  // namespace hookpoint::simulation
