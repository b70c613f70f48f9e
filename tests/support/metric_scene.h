// A block on a slope and what a metric makes of a motion that the test writes: no engine runs.
#pragma once

#include <cmath>
#include <functional>
#include <optional>
#include <string_view>

#include "studies/measure/metric.h"

namespace hookpoint::testing {

/// A unit mass with four boundary points at the corners of a 0.2 m square, 0.05 m under its origin,
/// on a slope.
inline simulation::Experiment block_on_slope(double angle, double azimuth) {
  simulation::Experiment experiment;
  experiment.materials.resize(1);
  experiment.deltat = 0.01;
  simulation::TerrainSpec terrain;
  terrain.surface = contact::SlopeSurface{angle, azimuth};
  experiment.terrain = terrain;
  simulation::RobotSpec robot;
  robot.mobile = true;
  robot.base.mass = {1., {}, {1., 1., 1., 0., 0., 0.}};
  for (const double x : {-0.1, 0.1})
    for (const double y : {-0.1, 0.1}) robot.base.boundary_points.push_back({x, y, -0.05});
  robot.orientation = exponential(Vector3d{0., 0., azimuth}) * exponential(Vector3d{0., angle, 0.});
  robot.location = 0.05 * rotate(robot.orientation, Vector3d{0., 0., 1.});
  experiment.robots.push_back(robot);
  return experiment;
}

/// Shows `metric` the states that `move` writes at every step of `duration`.
inline std::optional<double> measure(
    const simulation::Experiment& experiment, std::string_view name, double settle, double duration,
    const std::function<void(const studies::RunContext&, simulation::WorldState&)>& move) {
  const studies::RunContext context = studies::make_context(experiment, settle, duration);
  const auto metric = studies::find_metric(name)->make(context);
  studies::Observer observer(context, true);
  simulation::WorldState world;
  world.bodies.resize(1);
  for (int step = 0; step <= std::lround(duration / experiment.deltat); ++step) {
    world.step = step;
    world.time = step * experiment.deltat;
    world.bodies[0].position = context.start;
    world.bodies[0].orientation = experiment.robots[0].orientation;
    move(context, world);
    metric->observe(observer.observe(world));
  }
  return metric->value();
}

}  // namespace hookpoint::testing
