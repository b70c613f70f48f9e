// What metrics of a robot that walks have in common.
#pragma once

#include <cmath>

#include "studies/metric.h"

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
    fallen_ = fallen_ || observation.height < fallen_share * start_height_ ||
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
  static Vector3d up(const simulation::BodyState& base) {
    return rotate(base.orientation, Vector3d{0., 0., 1.});
  }

  const RunContext& context_;
  Vector3d upright_, heading_;
  double start_height_;
  bool fallen_ = false;
};

}  // namespace hookpoint::studies
