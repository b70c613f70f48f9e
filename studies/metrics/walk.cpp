// Metrics of a robot that walks, from poses alone: so they mean the same under every engine.
#include <algorithm>
#include <cmath>
#include <limits>
#include <numbers>

#include "studies/metric.h"

namespace hookpoint::studies {
namespace {

constexpr double fallen_share = 0.5;                   // of the height at the start
constexpr double fallen_tilt = std::numbers::pi / 3.;  // [rad]
constexpr double least_walk = 1e-3;                    // [m]: a ratio to a shorter way is rounding

/// Watches a robot until it falls; what it does afterwards is no walk and is not counted.
class WalkMetric : public Metric {
 public:
  explicit WalkMetric(const RunContext& context)
      : context_(context),
        upright_(rotate(context.robot_spec().orientation, Vector3d{0., 0., 1.})),
        start_height_(height_over_ground(context.start)) {
    const Vector3d x = rotate(context.robot_spec().orientation, Vector3d{1., 0., 0.});
    const Vector3d along = tangential(x, context.normal);
    heading_ = norm(along) > 0. ? (1. / norm(along)) * along : x;
  }

  void observe(const Observation& observation) final {
    fallen_ = fallen_ ||
              height_over_ground(observation.body.position) < fallen_share * start_height_ ||
              tilt(observation.body) > fallen_tilt;
    if (!fallen_ && settled(context_, observation)) watch(observation);
  }

 protected:
  /// A step after `settle` of a robot that has not fallen.
  virtual void watch(const Observation& observation) = 0;

  bool fallen() const { return fallen_; }
  const RunContext& context() const { return context_; }
  const Vector3d& heading() const { return heading_; }
  /// Along the ground's normal [m]; infinite without ground.
  double height_over_ground(const Vector3d& point) const {
    return context_.ground ? -context_.ground->query(point).depth
                           : std::numeric_limits<double>::infinity();
  }
  /// Angle between the base's z and where it was at the start [rad].
  double tilt(const simulation::BodyState& base) const {
    const Vector3d z = rotate(base.orientation, Vector3d{0., 0., 1.});
    return std::atan2(norm(cross(upright_, z)), dot(upright_, z));
  }

 private:
  const RunContext& context_;
  Vector3d upright_, heading_;
  double start_height_;
  bool fallen_ = false;
};

class Fell : public WalkMetric {
 public:
  using WalkMetric::WalkMetric;
  std::optional<double> value() const override { return fallen() ? 1. : 0.; }

 private:
  void watch(const Observation&) override {}
};

/// The way of the base and its time.
class WalkedDistance : public WalkMetric {
 public:
  using WalkMetric::WalkMetric;
  std::optional<double> value() const override { return distance(); }

 protected:
  void watch(const Observation& observation) override {
    const double along = dot(observation.body.position, heading());
    if (!began_) {
      begin_ = along;
      from_ = observation.world.time;
      began_ = true;
    }
    end_ = along;
    to_ = observation.world.time;
  }
  double distance() const { return end_ - begin_; }
  double time() const { return to_ - from_; }

 private:
  bool began_ = false;
  double begin_ = 0., end_ = 0., from_ = 0., to_ = 0.;
};

class WalkingSpeed : public WalkedDistance {
 public:
  using WalkedDistance::WalkedDistance;
  std::optional<double> value() const override {
    if (fallen() || !(time() > 0.)) return std::nullopt;
    return distance() / time();
  }
};

/// A foot is the boundary point of a chain's last link that is deepest in the ground.
class FootSlip : public WalkedDistance {
 public:
  explicit FootSlip(const RunContext& context) : WalkedDistance(context) {
    simulation::for_each_link(context.robot_spec(), [&](const simulation::TreeLink& at) {
      if (at.is_last()) feet_.push_back({context.body + at.body, &at.link.body, 0, false, {}, {}});
    });
  }
  std::optional<double> value() const override {
    if (fallen() || feet_.empty() || std::abs(distance()) < least_walk) return std::nullopt;
    return path_ / static_cast<double>(feet_.size()) / std::abs(distance());
  }

 private:
  struct Foot {
    std::size_t body;
    const simulation::BodySpec* spec;
    std::size_t point;  ///< that was deepest
    bool inside;
    Vector3d position{};         ///< where it touched at the last step [m]
    contact::BallFrame frame{};  ///< how it stood there
  };

  void watch(const Observation& observation) override {
    WalkedDistance::watch(observation);
    if (!context().ground) return;
    for (Foot& foot : feet_) follow(foot, observation.world.bodies[foot.body]);
  }

  void follow(Foot& foot, const simulation::BodyState& body) {
    Foot now = foot;
    now.inside = false;
    contact::TilePoint deepest;
    for (std::size_t i = 0; i < foot.spec->boundary_points.size(); ++i) {
      const Vector3d p_WP = body.position + rotate(body.orientation, foot.spec->boundary_points[i]);
      contact::TilePoint tile = context().ground->query(p_WP);
      const double radius = foot.spec->boundary_radius(i);
      tile.depth += radius;
      if (!(tile.depth > 0.) || (now.inside && tile.depth <= deepest.depth)) continue;
      now.inside = true;
      now.point = i;
      now.position = p_WP - radius * tile.normal;
      now.frame = {body.orientation, tile.normal};
      deepest = tile;
    }
    if (foot.inside && now.inside && foot.point == now.point) {
      const double radius = foot.spec->boundary_radius(now.point);
      const Vector3d slip = now.position - foot.position -
                            contact::rolling_displacement(foot.frame, now.frame, radius);
      path_ += norm(tangential(slip, deepest.normal));
    }
    foot = now;
  }

  std::vector<Foot> feet_;
  double path_ = 0.;
};

/// A torque is held over the step that led to the state it is published with.
class CostOfTransport : public WalkedDistance {
 public:
  explicit CostOfTransport(const RunContext& context) : WalkedDistance(context) {
    const auto& robots = context.experiment->robots;
    for (std::size_t i = 0; i <= static_cast<std::size_t>(context.robot); ++i) {
      first_ += angles_.size();
      angles_.assign(simulation::joint_count(robots[i]), 0.);
    }
  }
  std::optional<double> value() const override {
    if (fallen() || angles_.empty() || std::abs(distance()) < least_walk) return std::nullopt;
    return work_ / (context().weight * std::abs(distance()));
  }

 private:
  void watch(const Observation& observation) override {
    WalkedDistance::watch(observation);
    for (std::size_t i = 0; i < angles_.size(); ++i) {
      const simulation::JointState& joint = observation.world.joints[first_ + i];
      if (watching_) work_ += std::abs(joint.torque * (joint.angle - angles_[i]));
      angles_[i] = joint.angle;
    }
    watching_ = true;
  }

  std::size_t first_ = 0;       ///< of the robot's joints among all that are published
  std::vector<double> angles_;  ///< at the step before
  bool watching_ = false;
  double work_ = 0.;
};

class BodyHeightMin : public WalkMetric {
 public:
  using WalkMetric::WalkMetric;
  std::optional<double> value() const override {
    return std::isfinite(least_) ? std::optional(least_) : std::nullopt;
  }

 private:
  void watch(const Observation& observation) override {
    least_ = std::min(least_, height_over_ground(observation.body.position));
  }
  double least_ = std::numeric_limits<double>::infinity();
};

class TiltMax : public WalkMetric {
 public:
  using WalkMetric::WalkMetric;
  std::optional<double> value() const override { return greatest_; }

 private:
  void watch(const Observation& observation) override {
    greatest_ = std::max(greatest_, tilt(observation.body));
  }
  double greatest_ = 0.;
};

}  // namespace

std::unique_ptr<Metric> make_fell(const RunContext& context) {
  return std::make_unique<Fell>(context);
}
std::unique_ptr<Metric> make_walked_distance(const RunContext& context) {
  return std::make_unique<WalkedDistance>(context);
}
std::unique_ptr<Metric> make_walking_speed(const RunContext& context) {
  return std::make_unique<WalkingSpeed>(context);
}
std::unique_ptr<Metric> make_foot_slip(const RunContext& context) {
  return std::make_unique<FootSlip>(context);
}
std::unique_ptr<Metric> make_cost_of_transport(const RunContext& context) {
  return std::make_unique<CostOfTransport>(context);
}
std::unique_ptr<Metric> make_body_height_min(const RunContext& context) {
  return std::make_unique<BodyHeightMin>(context);
}
std::unique_ptr<Metric> make_tilt_max(const RunContext& context) {
  return std::make_unique<TiltMax>(context);
}

}  // namespace hookpoint::studies
