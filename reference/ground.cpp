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
    GroundMesh mesh;
    for (int row = 0; row < grid.rows; ++row)
      for (int column = 0; column < grid.columns; ++column)
        mesh.vertices.push_back(
            {grid.origin_x + column * terrain.spacing, grid.origin_y + row * terrain.spacing,
             grid.heights[static_cast<std::size_t>(row) * grid.columns + column] - lowered_by});
    for (int row = 0; row + 1 < grid.rows; ++row)
      for (int column = 0; column + 1 < grid.columns; ++column) {
        const int here = row * grid.columns + column;
        const int above = here + grid.columns;
        mesh.triangles.push_back({here, here + 1, above + 1});
        mesh.triangles.push_back({here, above + 1, above});
      }
    return mesh;
  }
};

}  // namespace

Ground ground_of(const simulation::TerrainSpec& terrain, double lowered_by) {
  return std::visit(Builder{terrain, lowered_by}, terrain.surface);
}

}  // namespace hookpoint::reference
