#include <algorithm>

#include "simulation/engine_interface/engine.h"

namespace hookpoint::simulation {

bool ground_moves(const Experiment& experiment) {
  if (!experiment.terrain) return false;
  const TerrainSpec& terrain = *experiment.terrain;
  const Vector3d still;
  const std::string trail = experiment.world + "." + terrain.name + ".";
  return terrain.velocity != still || terrain.frame_velocity != still ||
         terrain.frame_angular_velocity != still ||
         std::ranges::any_of(experiment.wires,
                             [&](const WireSpec& wire) { return wire.to.starts_with(trail); });
}

bool obstacles_move(const Experiment& experiment) {
  const auto moves = [](const ObstacleSpec& obstacle) {
    return obstacle.velocity != Vector3d{} || obstacle.angular_velocity != Vector3d{};
  };
  return std::ranges::any_of(experiment.obstacles, moves) ||
         std::ranges::any_of(experiment.wires, [&](const WireSpec& wire) {
           return std::ranges::any_of(experiment.obstacles, [&](const ObstacleSpec& obstacle) {
             return wire.to.starts_with(experiment.world + "." + obstacle.name + ".");
           });
         });
}

bool surfaces_move(const Experiment& experiment) {
  return ground_moves(experiment) || obstacles_move(experiment);
}

void advance(SurfaceMotion& surface, double dt) {
  surface.position += dt * surface.velocity;
  if (surface.angular_velocity == Vector3d{}) return;
  surface.orientation =
      normalized(exponential(dt * surface.angular_velocity) * surface.orientation);
}

}  // namespace hookpoint::simulation
