// Metrics of feet while their legs are to stand, as the gait commands it: whether a foot stays in
// the ground, how deep, and whether it stays where it is. From poses, counts of contacts and the
// gait's ports, so they mean the same under every engine and law.
#include <algorithm>
#include <array>
#include <span>

#include "studies/measure/metric.h"
#include "studies/metrics/table.h"
#include "studies/metrics/walk_metric.h"

namespace hookpoint::studies {
namespace {

/// What is known of a foot's present stance.
struct Stance {
  bool seen = false;     ///< there was a step before
  bool touches = false;  ///< at the step before
  bool stands = false;   ///< at the step before

  bool whole = false;    ///< seen from its beginning
  bool touched = false;  ///< at some step of it
  long losses = 0;
  Vector3d slip{};     ///< from its first touch to its last [m]
  Vector3d astray{};   ///< since its last touch [m]
  double depth = 0.;   ///< sum over the steps that touch [m]
  long steps = 0;      ///< that touch
  double lift = 0.;    ///< greatest height over the ground between two touches [m]
  double height = 0.;  ///< since its last touch [m]
};

/// Counts the stances that lie whole between `settle` and the end or the fall, and in which the
/// foot touched. It touches while it is in the ground or carries its force: a law keeps its hook as
/// long as the point is inside, though the damper may pull; a peer lets bodies rest a little over
/// the surface.
class StanceMetric : public WalkMetric {
 public:
  using WalkMetric::WalkMetric;

 protected:
  /// Of all counted stances.
  struct Sums {
    long stances = 0, losses = 0, steps = 0;
    double slip = 0., depth = 0., lift = 0.;  ///< [m]
  };
  const Sums& sums() const { return sums_; }
  std::optional<double> per_stance(double sum) const {
    if (sums_.stances == 0) return std::nullopt;
    return sum / static_cast<double>(sums_.stances);
  }

 private:
  void watch(const Observation& observation) override {
    if (observation.stance.empty()) return;
    stances_.resize(observation.feet.size());
    for (std::size_t i = 0; i < stances_.size(); ++i) {
      const FootObservation& foot = observation.feet[i];
      follow(stances_[i], foot, *observation.stance[foot.chain] > 0.5);
    }
  }

  void follow(Stance& stance, const FootObservation& foot, bool stands) {
    const bool touches = foot.depth > 0. || foot.contacts > 0;
    if (stands && !stance.stands) {
      Stance next;
      next.whole = stance.seen;
      stance = next;
    } else if (stands) {
      if (stance.touches && !touches) ++stance.losses;
      if (stance.touched) {
        stance.astray += foot.slip;
        stance.height = std::max(stance.height, -foot.depth);
      }
    } else if (stance.stands && stance.whole && stance.touched) {
      add(stance);
    }
    if (stands && touches) {
      stance.touched = true;
      stance.slip += stance.astray;
      stance.astray = {};
      stance.lift = std::max(stance.lift, stance.height);
      stance.height = 0.;
      stance.depth += foot.depth;
      ++stance.steps;
    }
    stance.stands = stands;
    stance.touches = touches;
    stance.seen = true;
  }

  void add(const Stance& stance) {
    ++sums_.stances;
    sums_.losses += stance.losses;
    sums_.slip += norm(stance.slip);
    sums_.depth += stance.depth;
    sums_.lift += stance.lift;
    sums_.steps += stance.steps;
  }

  std::vector<Stance> stances_;
  Sums sums_;
};

class HookLosses : public StanceMetric {
 public:
  using StanceMetric::StanceMetric;
  std::optional<double> value() const override {
    return per_stance(static_cast<double>(sums().losses));
  }
};

class StanceSlip : public StanceMetric {
 public:
  using StanceMetric::StanceMetric;
  std::optional<double> value() const override { return per_stance(sums().slip); }
};

class StanceLift : public StanceMetric {
 public:
  using StanceMetric::StanceMetric;
  std::optional<double> value() const override { return per_stance(sums().lift); }
};

class StanceDepth : public StanceMetric {
 public:
  using StanceMetric::StanceMetric;
  std::optional<double> value() const override {
    if (sums().steps == 0) return std::nullopt;
    return sums().depth / static_cast<double>(sums().steps);
  }
};

std::unique_ptr<Metric> make_hook_losses(const RunContext& context) {
  return std::make_unique<HookLosses>(context);
}
std::unique_ptr<Metric> make_stance_slip(const RunContext& context) {
  return std::make_unique<StanceSlip>(context);
}
std::unique_ptr<Metric> make_stance_depth(const RunContext& context) {
  return std::make_unique<StanceDepth>(context);
}

std::unique_ptr<Metric> make_stance_lift(const RunContext& context) {
  return std::make_unique<StanceLift>(context);
}

}  // namespace

std::span<const MetricDefinition> stance_metrics() {
  static const auto rows = std::to_array<MetricDefinition>({
      {.name = "hook_losses",
       .unit = "",
       .doc =
           "contacts of a foot lost while its leg is to stand, per stance; nothing without a gait that tells `stance`",
       .make = make_hook_losses,
       .needs = {.feet = true, .stance = true}},
      {.name = "stance_slip",
       .unit = "m",
       .doc =
           "distance along the ground from where a foot first touches in a stance to where it last does, mean of the stances",
       .make = make_stance_slip,
       .needs = {.feet = true, .stance = true}},
      {.name = "stance_depth",
       .unit = "m",
       .doc = "mean depth of a foot in the ground while its leg is to stand and it touches",
       .make = make_stance_depth,
       .needs = {.feet = true, .stance = true}},
      {.name = "stance_lift",
       .unit = "m",
       .doc =
           "greatest height over the ground that a foot reaches between two touches of a stance, mean of the stances",
       .make = make_stance_lift,
       .needs = {.feet = true, .stance = true}},
  });
  return rows;
}

}  // namespace hookpoint::studies
