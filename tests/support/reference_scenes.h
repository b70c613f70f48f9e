// Scenes of the peers' tests, built without the language: a block on a slope, a free body.
#pragma once

#include <algorithm>
#include <cmath>
#include <memory>
#include <numbers>
#include <optional>
#include <string>
#include <string_view>
#include <vector>

#include "reference/engines.h"
#include "reference/experiment_checks.h"
#include "simulation/engine_interface/engine.h"

namespace hookpoint::reference_scenes {

inline constexpr double degree = std::numbers::pi / 180.;
inline constexpr double g = 9.81;

/// 1 kg, 0.2 x 0.2 x 0.1 m.
inline simulation::RobotSpec block() {
  simulation::RobotSpec robot;
  robot.name = "block";
  robot.mobile = true;
  robot.base.name = "base";
  robot.base.mass.mass = 1.;
  robot.base.mass.inertia = {0.05 / 12., 0.05 / 12., 0.08 / 12., 0., 0., 0.};
  simulation::ShapeSpec shape;
  shape.geometry = simulation::Box{{0.2, 0.2, 0.1}};
  robot.base.shapes.push_back(shape);
  return robot;
}

/// Directions of a slope, in the world.
struct SlopeAxes {
  Vector3d normal, downhill;
  Quaterniond
      orientation;  ///< of a body that lies on it, with its edges along the fall where azimuth is 0
};
inline SlopeAxes slope_axes(double angle, double azimuth) {
  const double s = std::sin(angle), c = std::cos(angle);
  const Vector3d along{std::cos(azimuth), std::sin(azimuth), 0.};
  const Vector3d axis{-along.y, along.x, 0.};
  return {s * along + Vector3d{0., 0., c}, c * along - Vector3d{0., 0., s},
          exponential(angle * axis)};
}

/// Gravity and a material, nothing else.
inline simulation::Experiment empty_world(double mu, double deltat, const std::string& settings) {
  simulation::Experiment experiment;
  experiment.deltat = deltat;
  experiment.settings = settings;
  simulation::MaterialSpec material;
  material.constants.static_friction = material.constants.kinetic_friction = mu;
  experiment.materials.push_back(material);
  return experiment;
}

/// The block at rest on a slope, its lowest corners on the plane.
inline simulation::Experiment sloped_block(double angle, double azimuth, double mu, double deltat,
                                           const std::string& settings = "default") {
  simulation::Experiment experiment = empty_world(mu, deltat, settings);
  simulation::TerrainSpec terrain;
  terrain.surface = simulation::SlopeSpec{angle, azimuth};
  experiment.terrain = terrain;
  const SlopeAxes axes = slope_axes(angle, azimuth);
  experiment.robots.push_back(block());
  experiment.robots[0].location = 0.05 * axes.normal;
  experiment.robots[0].orientation = axes.orientation;
  return experiment;
}

/// Where the block comes to, step by step, that is thrown on a slope of 15 deg until it rests: in `engine`, a
/// Peer or a ProgramEngine, with `factor` times that constant of its material.
template <class Maker>
std::vector<double> thrown(const Maker& engine, const std::string& settings,
                           double contact::MaterialConstants<double>::*constant, double factor) {
  simulation::Experiment experiment = sloped_block(15. * degree, 0.2, 0.5, 1e-3, settings);
  experiment.robots[0].angular_velocity = {0.3, -0.5, 0.2};
  experiment.robots[0].velocity = {0.02, 0.01, 0.};
  experiment.materials[0].constants.*constant *= factor;
  const auto world = engine.make(experiment);
  std::vector<double> values;
  for (int i = 0; i < 200 && world->step().ok(); ++i) {
    const auto& body = world->state().bodies[0];
    values.insert(values.end(), {body.position.x, body.position.y, body.position.z});
  }
  return values;
}

/// A slope that falls along +x, as tiles of a grid with cells of 0.5 m, 8 m wide.
inline simulation::TerrainSpec tilted_grid(double angle) {
  simulation::GridSpec grid;
  grid.columns = grid.rows = 17;
  grid.origin_x = grid.origin_y = -4.;
  for (int row = 0; row < grid.rows; ++row)
    for (int column = 0; column < grid.columns; ++column)
      grid.heights.push_back(-std::tan(angle) * (grid.origin_x + 0.5 * column));
  simulation::TerrainSpec terrain;
  terrain.spacing = 0.5;
  terrain.surface = grid;
  return terrain;
}

/// Steps until `time` [s]; false when a step fails.
inline bool run_until(simulation::Engine& engine, double deltat, double time) {
  const auto last = static_cast<std::int64_t>(std::llround(time / deltat));
  while (engine.state().step < last)
    if (!engine.step().ok()) return false;
  return true;
}

/// Mean downhill speed of the body's origin between two times [m/s].
inline double creep_speed(simulation::Engine& engine, const Vector3d& downhill, double deltat,
                          double from, double to) {
  run_until(engine, deltat, from);
  const double start = dot(engine.state().bodies[0].position, downhill);
  run_until(engine, deltat, to);
  return (dot(engine.state().bodies[0].position, downhill) - start) / (to - from);
}

/// The message of the refusal, empty when the engine takes the experiment.
inline std::string refusal(const reference::Peer& peer, const simulation::Experiment& experiment) {
  try {
    peer.make(experiment);
  } catch (const simulation::ExperimentError& error) {
    return error.what();
  }
  return "";
}

/// How the peer handles `feature` where it does not do as our engine does.
inline std::optional<simulation::EngineGap::Handling> gap_of(const reference::Peer& peer,
                                                             std::string_view feature) {
  const auto gaps = peer.describe().gaps;
  const auto gap = std::ranges::find(gaps, feature, &simulation::EngineGap::feature);
  if (gap == gaps.end()) return std::nullopt;
  return gap->handling;
}
inline bool refuses(const reference::Peer& peer, std::string_view feature) {
  return gap_of(peer, feature) == simulation::EngineGap::Handling::refused;
}

}  // namespace hookpoint::reference_scenes
