#include <algorithm>
#include <cstdint>
#include <map>
#include <utility>
#include <vector>

#include "simulation/experiment/ground.h"
#include "simulation/experiment/painted_parts.h"
#include "simulation/experiment/stairs_faces.h"
#include "simulation/run/shown_scene.h"

namespace hookpoint::simulation {
namespace {

constexpr double margin = 20.;           ///< of a plane without an edge [m]
constexpr std::size_t most_cells = 256;  ///< along a side of a grid

/// Tiles as triangles, each with those of its material.
class Tiles {
 public:
  explicit Tiles(const contact::Terrain& ground) : ground_(ground) {}

  /// The material of the tile at a point within it.
  int material(double x, double y) const { return ground_.query(x, y, 0.).material; }

  /// Convex, counter-clockwise; corners may coincide with the next.
  void add(int material, const std::vector<Vector3d>& corners) {
    output::SceneSurface& surface = surfaces_[material];
    std::vector<std::uint32_t> indices;
    for (const Vector3d& corner : corners) {
      const std::uint32_t index = index_of(material, surface, corner);
      if (std::ranges::find(indices, index) == indices.end()) indices.push_back(index);
    }
    for (std::size_t i = 2; i < indices.size(); ++i)
      surface.triangles.push_back({indices[0], indices[i - 1], indices[i]});
  }

  /// By material.
  std::map<int, output::SceneSurface> take() { return std::move(surfaces_); }

 private:
  std::uint32_t index_of(int material, output::SceneSurface& surface, const Vector3d& corner) {
    const auto [at, is_new] =
        indices_.try_emplace({material, corner.x, corner.y, corner.z},
                             static_cast<std::uint32_t>(surface.vertices.size()));
    if (is_new) surface.vertices.push_back(corner);
    return at->second;
  }

  struct Place {
    int material;
    double x, y, z;
    auto operator<=>(const Place&) const = default;
  };
  const contact::Terrain& ground_;
  std::map<int, output::SceneSurface> surfaces_;
  std::map<Place, std::uint32_t> indices_;
};

/// Of a plane: all of it, or, without an edge, from the least to the greatest of the values and
/// the margin beyond.
CellRow plane_cells(double spacing, double size, const std::vector<double>& values) {
  if (size > 0.) return cells_of_extent(-0.5 * size, spacing, size);
  if (values.empty()) return cells_between(spacing, -margin, margin);
  const auto [least, most] = std::ranges::minmax(values);
  return cells_between(spacing, least - margin, most + margin);
}

void add_plane(const Experiment& experiment, const contact::Terrain& ground, Tiles& tiles) {
  const TerrainSpec& terrain = *experiment.terrain;
  std::vector<double> xs, ys;
  for (const contact::MaterialPatch& patch : terrain.patches) {
    xs.insert(xs.end(), {patch.from_x, patch.to_x});
    ys.insert(ys.end(), {patch.from_y, patch.to_y});
  }
  for (const RobotSpec& robot : experiment.robots) {
    xs.push_back(robot.location.x);
    ys.push_back(robot.location.y);
  }
  const CellRow columns = plane_cells(terrain.spacing, terrain.size_x, xs);
  const CellRow rows = plane_cells(terrain.spacing, terrain.size_y, ys);
  for (PaintedPart& part : painted_parts(ground, columns, rows)) {
    for (Vector3d& corner : part.corners) corner.z = ground.query(corner).height;
    tiles.add(part.material, part.corners);
  }
}

/// The vertices of a grid along a side that are drawn.
std::vector<std::size_t> drawn(int vertices) {
  const auto cells = static_cast<std::size_t>(vertices - 1);
  const std::size_t stride = (cells + most_cells - 1) / most_cells;
  std::vector<std::size_t> indices;
  for (std::size_t i = 0; i < cells; i += stride) indices.push_back(i);
  indices.push_back(cells);
  return indices;
}

void add_grid(const contact::GridSurface& grid, double spacing, Tiles& tiles) {
  const auto vertex = [&](std::size_t column, std::size_t row) {
    return Vector3d{grid.origin_x + static_cast<double>(column) * spacing,
                    grid.origin_y + static_cast<double>(row) * spacing,
                    grid.heights[row * static_cast<std::size_t>(grid.columns) + column]};
  };
  const auto add = [&](const Vector3d& a, const Vector3d& b, const Vector3d& c) {
    tiles.add(tiles.material((a.x + b.x + c.x) / 3., (a.y + b.y + c.y) / 3.), {a, b, c});
  };
  const std::vector<std::size_t> columns = drawn(grid.columns), rows = drawn(grid.rows);
  for (std::size_t r = 1; r < rows.size(); ++r) {
    for (std::size_t c = 1; c < columns.size(); ++c) {
      const Vector3d low = vertex(columns[c - 1], rows[r - 1]), high = vertex(columns[c], rows[r]);
      add(low, vertex(columns[c], rows[r - 1]), high);
      add(low, high, vertex(columns[c - 1], rows[r]));
    }
  }
}

}  // namespace

std::vector<output::SceneSurface> shown_ground(const Experiment& experiment) {
  const auto ground = make_ground(experiment);
  if (!ground) return {};
  Tiles tiles(*ground);
  const TerrainSpec& terrain = *experiment.terrain;
  if (has_risers(experiment)) {
    for (const StairsFace& face : stairs_faces(*ground)) tiles.add(face.material, face.corners);
  } else if (const auto* grid = std::get_if<contact::GridSurface>(&terrain.surface)) {
    add_grid(*grid, terrain.spacing, tiles);
  } else {
    add_plane(experiment, *ground, tiles);
  }
  std::vector<output::SceneSurface> surfaces;
  for (auto& [material, surface] : tiles.take()) {
    surface.name = experiment.world + "." + terrain.name;
    surface.material = experiment.materials[static_cast<std::size_t>(material)].name;
    surfaces.push_back(std::move(surface));
  }
  return surfaces;
}

}  // namespace hookpoint::simulation
