#include "reference/ground.h"

#include <algorithm>
#include <cmath>
#include <string>

namespace hookpoint::reference {
namespace {

struct Builder {
  const simulation::TerrainSpec& terrain;

  Ground operator()(const simulation::FlatSpec& flat) const {
    return GroundPlane{{0., 0., 1.}, flat.height};
  }

  Ground operator()(const simulation::SlopeSpec& slope) const {
    const double along = std::sin(slope.angle);
    return GroundPlane{
        {along * std::cos(slope.azimuth), along * std::sin(slope.azimuth), std::cos(slope.angle)},
        0.};
  }

  Ground operator()(const simulation::GridSpec& grid) const {
    if (grid.stairs) return GroundStairs{};
    return simulation::grid_mesh(grid, terrain.spacing);
  }
};

}  // namespace

bool ground_frame_moves(const simulation::Experiment& experiment) {
  const simulation::TerrainSpec& terrain = *experiment.terrain;
  const std::string trail = experiment.world + "." + terrain.name + ".frame_";
  return terrain.frame_velocity != Vector3d{} || terrain.frame_angular_velocity != Vector3d{} ||
         std::ranges::any_of(experiment.wires, [&](const simulation::WireSpec& wire) {
           return wire.to.starts_with(trail);
         });
}

Vector3d along_ground(const simulation::TerrainSpec& terrain, const Vector3d& velocity) {
  const Ground ground = ground_of(terrain);
  const auto* plane = std::get_if<GroundPlane>(&ground);
  return plane != nullptr ? tangential(velocity, plane->normal) : velocity;
}

Ground ground_of(const simulation::TerrainSpec& terrain) {
  return std::visit(Builder{terrain}, terrain.surface);
}

}  // namespace hookpoint::reference
