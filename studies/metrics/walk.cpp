// Metrics of a robot that walks, from poses alone: so they mean the same under every engine.
#include <algorithm>
#include <array>
#include <cmath>
#include <limits>
#include <span>

#include "studies/measure/metric.h"
#include "studies/metrics/table.h"
#include "studies/metrics/walk_metric.h"
#include "studies/predictions/predictions.h"

namespace hookpoint::studies {
namespace {

/// A robot has fallen by its height over the ground under its feet too.
constexpr MetricNeeds sees_feet{.feet = true};
constexpr double least_walk = 1e-3;  // [m]: a ratio to a shorter way is rounding

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

class FootSlip : public WalkedDistance {
 public:
  using WalkedDistance::WalkedDistance;
  std::optional<double> value() const override {
    if (fallen() || inside_.empty() || std::abs(distance()) < least_walk) return std::nullopt;
    return path_ / static_cast<double>(inside_.size()) / std::abs(distance());
  }

 private:
  void watch(const Observation& observation) override {
    WalkedDistance::watch(observation);
    inside_.resize(observation.feet.size(), false);
    for (std::size_t i = 0; i < inside_.size(); ++i) {
      const FootObservation& foot = observation.feet[i];
      const bool inside = foot.depth > 0.;
      if (inside && inside_[i]) path_ += norm(foot.slip);
      inside_[i] = inside;
    }
  }

  std::vector<bool> inside_;  ///< each foot, at the step before
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
    least_ = std::min(least_, observation.height);
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

}  // namespace

std::span<const MetricDefinition> walk_metrics() {
  static const auto rows = std::to_array<MetricDefinition>({
      {.name = "fell",
       .unit = "",
       .doc =
           "1 if the base came lower over the lowest ground under it and its feet than half its height at the start, or its z turned by more than 60 deg; else 0",
       .make = make_fell,
       .predict = predicted::fell,
       .needs = sees_feet},
      {.name = "walked_distance",
       .unit = "m",
       .doc =
           "displacement of the base from `settle` to the end or the fall, along its x at the start",
       .make = make_walked_distance,
       .needs = sees_feet},
      {.name = "walking_speed",
       .unit = "m/s",
       .doc = "walked_distance over its time; nothing for a robot that fell",
       .make = make_walking_speed,
       .needs = sees_feet},
      {.name = "foot_slip",
       .unit = "",
       .doc = "path of a foot over the ground while in it, mean of the feet, per walked_distance",
       .make = make_foot_slip,
       .needs = sees_feet},
      {.name = "cost_of_transport",
       .unit = "",
       .doc =
           "work of the joints' torques, taken positive whichever way it goes, per weight and walked_distance",
       .make = make_cost_of_transport,
       .needs = sees_feet},
      {.name = "body_height_min",
       .unit = "m",
       .doc = "least height of the base over the ground after `settle`",
       .make = make_body_height_min,
       .needs = sees_feet},
      {.name = "tilt_max",
       .unit = "rad",
       .doc = "greatest angle after `settle` of the base's z from where it was at the start",
       .make = make_tilt_max,
       .needs = sees_feet},
  });
  return rows;
}

}  // namespace hookpoint::studies
