// What metrics of a robot that walks have in common.
#pragma once

#include <algorithm>
#include <cmath>

#include "studies/measure/metric.h"

namespace hookpoint::studies {

/// Watches a robot until it falls; what it does afterwards is no walk and is not counted.
class WalkMetric : public Metric {
 public:
  explicit WalkMetric(const RunContext& context)
      : context_(context),
        upright_(rotate(context.start_orientation, Vector3d{0., 0., 1.})),
        start_height_(height_over_ground(context, context.start)) {
    const Vector3d x = rotate(context.start_orientation, Vector3d{1., 0., 0.});
    const Vector3d along = tangential(x, context.normal);
    heading_ = norm(along) > 0. ? (1. / norm(along)) * along : x;
  }

  void observe(const Observation& observation) final {
    constexpr double fallen_share = 0.5;   // of the height at the start
    constexpr double fallen_cosine = 0.5;  // of the tilt: 60 deg
    fallen_ = fallen_ || height_over_lowest(observation) < fallen_share * start_height_ ||
              dot(upright_, up(observation.body)) < fallen_cosine;
    if (!fallen_ && settled(context_, observation)) watch(observation);
  }

 protected:
  /// A step after `settle` of a robot that has not fallen.
  virtual void watch(const Observation& observation) = 0;

  bool fallen() const { return fallen_; }
  const RunContext& context() const { return context_; }
  const Vector3d& heading() const { return heading_; }
  /// Angle between the base's z and where it was at the start [rad].
  double tilt(const simulation::BodyState& base) const {
    const Vector3d z = up(base);
    return std::atan2(norm(cross(upright_, z)), dot(upright_, z));
  }

 private:
  /// Over the lowest ground that is under the base or a foot: before a step the ground under the base
  /// rises, and the robot has not fallen.
  double height_over_lowest(const Observation& observation) const {
    double height = observation.height;
    if (!context_.ground || simulation::is_plane(context_.ground->description())) return height;
    for (const FootObservation& foot : observation.feet) {
      const double depth = context_.ground->query(foot.position).depth;
      const Vector3d below = foot.position + depth * context_.normal;
      height = std::max(height, dot(observation.body.position - below, context_.normal));
    }
    return height;
  }
  static Vector3d up(const simulation::BodyState& base) {
    return rotate(base.orientation, Vector3d{0., 0., 1.});
  }

  const RunContext& context_;
  Vector3d upright_, heading_;
  double start_height_;
  bool fallen_ = false;
};

}  // namespace hookpoint::studies
