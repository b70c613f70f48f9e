// A scene of configs/ that walks, watched by the studies' metrics.
#pragma once

#include <cmath>
#include <map>
#include <memory>
#include <string>

#include "simulation/dts_engine/dts_engine.h"
#include "simulation/run/world.h"
#include "studies/measure/metric.h"
#include "tests/support/scene.h"

namespace hookpoint::testing {

struct Walk {
  bool finished = false, fell = true;
  double speed = 0., slip = 0., depth = 0., tilt = 0.;
  Vector3d end;         ///< of the base of the first robot [m]
  double heading = 0.;  ///< of its x at the end [rad]
};

/// The metrics count from `settle` [s] on.
inline Walk walk(const std::string& scene, const std::map<std::string, std::string>& parameters,
                 double settle, double duration,
                 simulation::EngineFactory make = simulation::make_dts) {
  const simulation::Experiment experiment = load_scene("scenes/" + scene, parameters);
  const studies::RunContext context = studies::make_context(experiment, settle, duration);
  studies::Observer observer(context, true, true);
  std::map<std::string, std::unique_ptr<studies::Metric>> metrics;
  for (const char* name : {"fell", "walking_speed", "foot_slip", "penetration_max", "tilt_max"})
    metrics[name] = studies::find_metric(name)->make(context);
  simulation::World world(experiment, make(experiment));
  const auto observe = [&] {
    const studies::Observation seen = observer.observe(world.state());
    for (const auto& [name, metric] : metrics) metric->observe(seen);
  };
  observe();
  while (world.state().time < duration - 0.5 * experiment.deltat) {
    if (!world.step().ok()) return {};
    observe();
  }
  const auto value = [&](const char* name) { return metrics[name]->value().value_or(-1.); };
  const simulation::BodyState& base = world.state().bodies[0];
  const Vector3d ahead = rotate(base.orientation, Vector3d{1., 0., 0.});
  return {true,
          value("fell") > 0.,
          value("walking_speed"),
          value("foot_slip"),
          value("penetration_max"),
          value("tilt_max"),
          base.position,
          std::atan2(ahead.y, ahead.x)};
}

}  // namespace hookpoint::testing
