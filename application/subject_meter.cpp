#include "application/subject_meter.h"

#include <cmath>
#include <limits>
#include <utility>

#include "studies/metric.h"
#include "studies/predictions/predictions.h"

namespace hookpoint::application {
namespace {

using studies::Observation;
using studies::RunContext;

constexpr double unknown = std::numeric_limits<double>::quiet_NaN();

/// The way down a slope in time: what a law gives in at once, and what it creeps; or a slide.
struct PredictedWay {
  double shift = unknown;  ///< [m]
  double speed = unknown;  ///< [m/s]
  std::optional<studies::RigidSlide> slide;

  double at(double time) const {
    if (slide) return slide->displacement(time);
    return (std::isnan(shift) ? 0. : shift) + speed * time;
  }
};

class StudyMeter final : public view::Meter {
 public:
  StudyMeter(const studies::PeerContact& peer, RunContext context)
      : context_(std::move(context)), observer_(context_, true) {
    const auto predicted = [&](const char* metric) {
      return studies::predict(metric, context_, peer).value_or(unknown);
    };
    if (studies::regime_of(context_) == studies::Regime::slides)
      way_.slide = studies::rigid_slide(context_);
    way_.shift = predicted("stick_displacement");
    way_.speed = predicted("creep_speed");
    penetration_ = predicted("penetration_mean");
    load_ = studies::support_force(context_).value_or(unknown);
    slip_ = studies::find_metric("slip_distance")->make(context_);
    way_of_points_ = studies::find_metric("stick_displacement")->make(context_);
  }

  void observe(const simulation::WorldState& state) override {
    const Observation observation = observer_.observe(state);
    slip_->observe(observation);
    way_of_points_->observe(observation);
    // Of the feet, as the closed forms have it: the body leans besides. Of one in the air, the
    // body.
    reading_.displacement = way_of_points_->value().value_or(observation.displacement);
    reading_.displacement_predicted = way_.at(state.time);
    reading_.slip = slip_->value().value_or(unknown);
    // Of a body whose points hold, what they creep is their slip.
    reading_.slip_predicted = std::abs(way_.speed) * state.time;
    reading_.penetration = mean_depth(observation);
    reading_.penetration_predicted = penetration_;
    Vector3d force;
    studies::for_each_body(context_, state,
                           [&](const simulation::BodySpec&, const simulation::BodyState& body) {
                             force += body.contact_force;
                           });
    reading_.load = dot(force, context_.normal);
    reading_.load_predicted = load_;
  }

  view::Reading read() const override { return reading_; }

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
  PredictedWay way_;
  double penetration_ = unknown, load_ = unknown;
  view::Reading reading_{};
};

}  // namespace

std::unique_ptr<view::Meter> make_meter(const simulation::Experiment& experiment,
                                        const studies::EngineTable& engines) {
  const auto engine = engines.find(experiment.engine);
  if (engine == engines.end()) return nullptr;
  try {
    RunContext context = studies::make_context(experiment, 0., experiment.duration);
    if (!context.ground) return nullptr;
    context.make = engine->second.make;
    return std::make_unique<StudyMeter>(studies::peer_contact(engine->second, experiment),
                                        std::move(context));
  } catch (const simulation::ExperimentError&) {
    return nullptr;  // no robot moves
  }
}

}  // namespace hookpoint::application
