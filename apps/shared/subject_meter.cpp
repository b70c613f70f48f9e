#include "apps/shared/subject_meter.h"

#include <algorithm>
#include <cmath>
#include <limits>
#include <utility>

#include "studies/measure/metric.h"
#include "studies/predictions/predictions.h"

namespace hookpoint::application {
namespace {

using studies::Observation;
using studies::RunContext;

constexpr double unknown = std::numeric_limits<double>::quiet_NaN();

using view::Tally;

/// The way down a slope since `time` 0 of the constants: what a law creeps, or a slide.
struct PredictedWay {
  double speed = unknown;  ///< [m/s]
  std::optional<studies::RigidSlide> slide;

  double at(double time) const { return slide ? slide->displacement(time) : speed * time; }
};

double known_or(double value, double otherwise) { return std::isnan(value) ? otherwise : value; }

class StudyMeter final : public view::Meter {
 public:
  StudyMeter(const studies::PeerContact& peer, RunContext context, const Tally& behind)
      : context_(std::move(context)), observer_(context_, true), behind_(behind) {
    const auto predicted = [&](const char* metric) {
      return studies::predict(metric, context_, peer).value().value_or(unknown);
    };
    give_in_ = known_or(studies::tangential_give(context_).value().value_or(unknown), 0.);
    // A start in balance has it behind it.
    if (behind_.predicted.since == 0. && context_.robot_spec().settled)
      behind_.predicted.give_in = give_in_;
    way_.speed = predicted("creep_speed");
    if (studies::regime_of(context_) == studies::Regime::slides) {
      // From rest, or from the file's speed: of a change on the way nobody knows what it began at.
      if (behind_.predicted.since == 0.) way_.slide = studies::rigid_slide(context_);
      way_.speed = unknown;
    }
    penetration_ = predicted("penetration_mean");
    load_ = studies::predicted::support_force(context_, peer).value().value_or(unknown);
    slip_ = studies::find_metric("slip_distance")->make(context_);
    way_of_points_ = studies::find_metric("stick_displacement")->make(context_);
  }

  void observe(const simulation::WorldState& state) override {
    const Observation observation = observer_.observe(state);
    slip_->observe(observation);
    way_of_points_->observe(observation);
    // Of the feet, as the closed forms have it: the body leans besides. Of one in the air, the
    // body.
    if (!start_) start_ = observation.displacement;
    reading_.displacement =
        behind_.displacement + way_of_points_->value().value_or(observation.displacement - *start_);
    const Tally::Predicted& predicted = behind_.predicted;
    const double time = state.time - predicted.since;
    reading_.displacement_predicted =
        predicted.displacement + give_in_ - predicted.give_in + way_.at(time);
    reading_.slip = behind_.slip + slip_->value().value_or(unknown);
    // Of a body whose points hold, what they creep is their slip.
    reading_.slip_predicted = predicted.slip + std::abs(way_.speed) * time;
    reading_.penetration = mean_depth(observation);
    reading_.penetration_predicted = penetration_;
    Vector3d force;
    studies::for_each_body(context_, state,
                           [&](const simulation::BodySpec&, const simulation::BodyState& body) {
                             force += body.contact_force;
                           });
    reading_.load = dot(force, context_.normal);
    reading_.load_predicted = load_;
    time_ = state.time;
  }

  view::Reading read() const override { return reading_; }

  Tally tally() const override { return {reading_.displacement, reading_.slip, behind_.predicted}; }
  /// Where nothing is predicted, what follows is predicted from what was measured.
  Tally tally_before_change() const override {
    return {reading_.displacement,
            reading_.slip,
            {time_, known_or(reading_.displacement_predicted, reading_.displacement),
             known_or(reading_.slip_predicted, reading_.slip), give_in_}};
  }

 private:
  static double mean_depth(const Observation& observation) {
    double sum = 0.;
    int count = 0;
    for (const studies::PointObservation& point : observation.points) {
      if (!(point.depth > -studies::touching_gap)) continue;
      sum += point.depth;
      ++count;
    }
    return count == 0 ? unknown : sum / count;
  }

  RunContext context_;
  studies::Observer observer_;
  std::unique_ptr<studies::Metric> slip_, way_of_points_;
  Tally behind_;
  std::optional<double> start_;  ///< displacement of the body at the first instant [m]
  PredictedWay way_;
  double give_in_ = 0.;  ///< of slack springs under the weight, by its closed form [m]
  double penetration_ = unknown, load_ = unknown;
  double time_ = 0.;  ///< of the reading [s]
  view::Reading reading_{};
};

}  // namespace

std::unique_ptr<view::Meter> make_meter(const simulation::Experiment& experiment,
                                        const studies::EngineTable& engines,
                                        const view::Tally& behind) {
  const studies::EngineEntry* engine = engines.find(experiment.engine);
  const bool moves = std::ranges::any_of(experiment.robots, &simulation::RobotSpec::mobile);
  if (engine == nullptr || !moves) return nullptr;
  try {
    RunContext context = studies::make_context(experiment, 0., experiment.duration);
    if (!context.ground) return nullptr;
    context.make = engine->make;
    context.one_friction = engine->has_one_friction(experiment);
    return std::make_unique<StudyMeter>(studies::peer_contact(*engine, experiment),
                                        std::move(context), behind);
  } catch (const simulation::ExperimentError&) {
    return nullptr;  // the run itself says why
  }
}

}  // namespace hookpoint::application
