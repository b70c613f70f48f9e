// Metrics of the contact: depths, paths of points, contacts lost, impulses.
#include <algorithm>
#include <array>
#include <cmath>
#include <limits>
#include <span>

#include "studies/measure/metric.h"
#include "studies/metrics/table.h"
#include "studies/predictions/predictions.h"

namespace hookpoint::studies {
namespace {

/// Depths of the points inside the ground after `settle`: greatest, sum, sum of squares.
class Depths : public Metric {
 public:
  explicit Depths(const RunContext& context) : context_(context) {}
  void observe(const Observation& observation) override {
    if (!settled(context_, observation)) return;
    for (const PointObservation& point : observation.points) {
      if (!(point.depth > 0.)) continue;
      greatest_ = std::max(greatest_, point.depth);
      sum_ += point.depth;
      squares_ += point.depth * point.depth;
      ++count_;
    }
  }

 protected:
  double greatest() const { return greatest_; }
  double mean() const { return count_ == 0 ? 0. : sum_ / static_cast<double>(count_); }
  double root_mean_square() const {
    return count_ == 0 ? 0. : std::sqrt(squares_ / static_cast<double>(count_));
  }

 private:
  const RunContext& context_;
  double greatest_ = 0., sum_ = 0., squares_ = 0.;
  long count_ = 0;
};

class PenetrationMax : public Depths {
 public:
  using Depths::Depths;
  std::optional<double> value() const override { return greatest(); }
};
class PenetrationMean : public Depths {
 public:
  using Depths::Depths;
  std::optional<double> value() const override { return mean(); }
};
class PenetrationRms : public Depths {
 public:
  using Depths::Depths;
  std::optional<double> value() const override { return root_mean_square(); }
};

/// Contact points, not the body's origin: the body also leans on its springs, which moves the
/// origin but not its feet.
class StickDisplacement : public Metric {
 public:
  explicit StickDisplacement(const RunContext& context) : context_(context) {}
  void observe(const Observation& observation) override {
    if (start_.empty())
      for (const PointObservation& point : observation.points) start_.push_back(point.position);
    double sum = 0.;
    int count = 0;
    for (std::size_t i = 0; i < observation.points.size(); ++i) {
      if (observation.points[i].depth < -touching_gap) continue;
      sum += dot(observation.points[i].position - start_[i], context_.downhill);
      ++count;
    }
    displacement_ = count == 0 ? std::nullopt : std::optional(sum / count);
  }
  std::optional<double> value() const override { return displacement_; }

 private:
  const RunContext& context_;
  std::vector<Vector3d> start_;
  std::optional<double> displacement_;
};

class SlipDistance : public Metric {
 public:
  static constexpr double loaded = 0.01;  ///< part of the weight that the ground must carry
  explicit SlipDistance(const RunContext& context) : context_(context) {}
  void observe(const Observation& observation) override {
    const std::size_t count = observation.points.size();
    if (last_.empty()) {
      path_.assign(count, 0.);
      for (const PointObservation& point : observation.points) last_.push_back(point.position);
    }
    Vector3d force;
    for_each_body(context_, observation.world,
                  [&](const simulation::BodySpec&, const simulation::BodyState& body) {
                    force += body.contact_force;
                  });
    const bool carried = dot(force, context_.normal) > loaded * context_.weight;
    for (std::size_t i = 0; i < count; ++i) {
      const PointObservation& point = observation.points[i];
      if (carried && point.depth > -touching_gap)
        path_[i] += norm(tangential(point.position - last_[i], context_.normal));
      last_[i] = point.position;
    }
  }
  std::optional<double> value() const override {
    return path_.empty() ? std::nullopt
                         : std::optional(*std::max_element(path_.begin(), path_.end()));
  }

 private:
  const RunContext& context_;
  std::vector<Vector3d> last_;
  std::vector<double> path_;
};

class ContactBreaks : public Metric {
 public:
  explicit ContactBreaks(const RunContext& context) : context_(context) {}
  void observe(const Observation& observation) override {
    const int contacts = observation.body.contacts;
    if (settled(context_, observation)) {
      if (watching_) lost_ += std::max(0, last_ - contacts);
      watching_ = true;
    }
    last_ = contacts;
  }
  std::optional<double> value() const override {
    return static_cast<double>(lost_) / (context_.duration - context_.settle);
  }

 private:
  const RunContext& context_;
  int last_ = 0;
  long lost_ = 0;
  bool watching_ = false;
};

/// Only where the law counts impulses; a force law has none.
class Impacts : public Metric {
 public:
  explicit Impacts(const RunContext& context) : context_(context) {}
  void observe(const Observation& observation) override {
    if (!settled(context_, observation)) return;
    if (!from_) from_ = observation.world.impacts;
    to_ = observation.world.impacts;
  }
  std::optional<double> value() const override {
    if (to_ == 0 || !from_) return std::nullopt;
    return static_cast<double>(to_ - *from_) / (context_.duration - context_.settle);
  }

 private:
  const RunContext& context_;
  std::optional<std::uint64_t> from_;
  std::uint64_t to_ = 0;
};

std::unique_ptr<Metric> make_stick_displacement(const RunContext& context) {
  return std::make_unique<StickDisplacement>(context);
}
std::unique_ptr<Metric> make_slip_distance(const RunContext& context) {
  return std::make_unique<SlipDistance>(context);
}
std::unique_ptr<Metric> make_penetration_max(const RunContext& context) {
  return std::make_unique<PenetrationMax>(context);
}
std::unique_ptr<Metric> make_penetration_mean(const RunContext& context) {
  return std::make_unique<PenetrationMean>(context);
}
std::unique_ptr<Metric> make_penetration_rms(const RunContext& context) {
  return std::make_unique<PenetrationRms>(context);
}
std::unique_ptr<Metric> make_contact_breaks(const RunContext& context) {
  return std::make_unique<ContactBreaks>(context);
}
std::unique_ptr<Metric> make_impacts(const RunContext& context) {
  return std::make_unique<Impacts>(context);
}

}  // namespace

std::span<const MetricDefinition> contact_metrics() {
  static const auto rows = std::to_array<MetricDefinition>({
      {.name = "stick_displacement",
       .unit = "m",
       .doc = "mean downhill displacement of the points that touch at the end",
       .make = make_stick_displacement,
       .predict = predicted::stick_displacement,
       .needs = {.points = true},
       .regime = Regime::holds},
      {.name = "slip_distance",
       .unit = "m",
       .doc = "longest tangential path of a boundary point while it is loaded",
       .make = make_slip_distance,
       .needs = {.points = true, .contact_force = true}},
      {.name = "penetration_max",
       .unit = "m",
       .doc = "greatest depth of a boundary point after `settle`",
       .make = make_penetration_max,
       .predict = predicted::penetration_max,
       .needs = {.points = true}},
      {.name = "penetration_mean",
       .unit = "m",
       .doc = "mean depth of the points inside the ground after `settle`",
       .make = make_penetration_mean,
       .predict = predicted::penetration_mean,
       .needs = {.points = true}},
      {.name = "penetration_rms",
       .unit = "m",
       .doc = "root mean square of the same depths",
       .make = make_penetration_rms,
       .predict = predicted::penetration_rms,
       .needs = {.points = true}},
      {.name = "contact_breaks",
       .unit = "1/s",
       .doc = "contacts lost per second after `settle`",
       .make = make_contact_breaks},
      {.name = "impacts",
       .unit = "1/s",
       .doc = "impulses per second after `settle` (event-driven laws)",
       .make = make_impacts,
       .predict = predicted::impacts},
  });
  return rows;
}

}  // namespace hookpoint::studies
