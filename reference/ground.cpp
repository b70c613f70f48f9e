#include "reference/ground.h"

#include <cmath>

namespace hookpoint::reference {
namespace {

struct Builder {
  const simulation::TerrainSpec& terrain;
  double lowered_by;

  Ground operator()(const simulation::FlatSpec& flat) const {
    return GroundPlane{{0., 0., 1.}, flat.height - lowered_by};
  }

  Ground operator()(const simulation::SlopeSpec& slope) const {
    const double along = std::sin(slope.angle);
    return GroundPlane{
        {along * std::cos(slope.azimuth), along * std::sin(slope.azimuth), std::cos(slope.angle)},
        -lowered_by};
  }

  Ground operator()(const simulation::GridSpec& grid) const {
    GroundMesh mesh = simulation::grid_mesh(grid, terrain.spacing);
    for (Vector3d& vertex : mesh.vertices) vertex.z -= lowered_by;
    return mesh;
  }
};

}  // namespace

Ground ground_of(const simulation::TerrainSpec& terrain, double lowered_by) {
  return std::visit(Builder{terrain, lowered_by}, terrain.surface);
}

}  // namespace hookpoint::reference
