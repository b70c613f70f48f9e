#include "simulation/experiment/ground_mesh.h"

#include <algorithm>
#include <cmath>
#include <limits>
#include <numeric>

#include "contact/terrain/terrain.h"
#include "simulation/experiment/stairs_faces.h"

namespace hookpoint::simulation {
namespace {

/// What is shown of a plane without an end, beyond what stands or lies on it [m].
constexpr double margin = 5.;

/// Along x or along y.
struct Stretch {
  double from = std::numeric_limits<double>::infinity();
  double to = -std::numeric_limits<double>::infinity();
  void include(double s) {
    from = std::min(from, s);
    to = std::max(to, s);
  }
};

/// The cells that are shown along x or along y: lines between them, at `origin` + i `spacing`, but
/// for the last, which ends with the ground.
struct Cells {
  double origin = 0., spacing = 1., end = std::numeric_limits<double>::infinity();
  double first = 0., count = 0.;

  double line(double i) const { return std::min(origin + (first + i) * spacing, end); }
  /// Keeps no more than `most` of them, those about `middle`.
  void cut(double most, double middle) {
    if (count <= most) return;
    const double wanted = std::floor((middle - origin) / spacing) - std::floor(most / 2.);
    first = std::clamp(wanted, first, first + count - most);
    count = most;
  }
  /// `factor` cells as one.
  void widen(double factor) {
    const double last = std::ceil((first + count) / factor);
    first = std::floor(first / factor);
    count = last - first;
    spacing *= factor;
  }
};

Cells cells_along(double extent, double spacing, Stretch shown) {
  if (extent > 0.) {
    return {-0.5 * extent, spacing, 0.5 * extent, 0., std::ceil(extent / spacing)};
  }
  Cells cells{0., spacing};
  cells.first = std::floor((shown.from - margin) / spacing);
  cells.count = std::ceil((shown.to + margin) / spacing) - cells.first;
  return cells;
}

class Tiling {
 public:
  Tiling(const Experiment& experiment, double most)
      : terrain_(*experiment.terrain), ground_(terrain_) {
    for (const RobotSpec& robot : experiment.robots) {
      robots_x_.include(robot.location.x);
      robots_y_.include(robot.location.y);
    }
    if (experiment.robots.empty()) {
      robots_x_.include(0.);
      robots_y_.include(0.);
    }
    choose_cells();
    const double factor = std::ceil(std::sqrt(columns_.count * rows_.count / most));
    if (factor <= 1.) return;
    if (is_plane() && terrain_.patches.empty()) {
      columns_.widen(factor);
      rows_.widen(factor);
    } else {
      const double side = std::floor(std::sqrt(most));
      const double width = std::max(side, std::floor(most / rows_.count));
      const double height = std::max(side, std::floor(most / columns_.count));
      columns_.cut(width, 0.5 * (robots_x_.from + robots_x_.to));
      rows_.cut(height, 0.5 * (robots_y_.from + robots_y_.to));
    }
  }

  GroundTiles run() {
    const int width = static_cast<int>(columns_.count) + 1;
    for (double row = 0.; row <= rows_.count; ++row) {
      for (double column = 0.; column <= columns_.count; ++column)
        tiles_.vertices.push_back(vertex(column, row));
    }
    for (int row = 0; row < static_cast<int>(rows_.count); ++row) {
      for (int column = 0; column + 1 < width; ++column) {
        const int here = row * width + column;
        add_cell(here, here + 1, here + width + 1, here + width);
      }
    }
    return std::move(tiles_);
  }

 private:
  bool is_plane() const { return !std::holds_alternative<GridSpec>(terrain_.surface); }

  void choose_cells() {
    if (const auto* grid = std::get_if<GridSpec>(&terrain_.surface)) {
      columns_ = {grid->origin_x, terrain_.spacing};
      rows_ = {grid->origin_y, terrain_.spacing};
      columns_.count = grid->columns - 1;
      rows_.count = grid->rows - 1;
      return;
    }
    Stretch x = robots_x_, y = robots_y_;
    for (const PatchSpec& patch : terrain_.patches) {
      x.include(patch.from_x);
      x.include(patch.to_x);
      y.include(patch.from_y);
      y.include(patch.to_y);
    }
    columns_ = cells_along(terrain_.size_x, terrain_.spacing, x);
    rows_ = cells_along(terrain_.size_y, terrain_.spacing, y);
  }

  /// A grid's as it is written: its edge belongs to the cell inside.
  Vector3d vertex(double column, double row) const {
    const double x = columns_.line(column), y = rows_.line(row);
    if (const auto* grid = std::get_if<GridSpec>(&terrain_.surface)) {
      const auto at =
          static_cast<std::size_t>((rows_.first + row) * grid->columns + columns_.first + column);
      return {x, y, grid->heights[at]};
    }
    return {x, y, ground_.query(x, y, 0.).height};
  }

  int material_at(int a, int b, int c) const {
    const Vector3d center =
        1. / 3. * (tiles_.vertices[a] + tiles_.vertices[b] + tiles_.vertices[c]);
    return ground_.query(center).material;
  }

  /// Corners from the lower left on; the diagonal is from the first to the third.
  void add_cell(int a, int b, int c, int d) {
    const int lower = material_at(a, b, c), upper = material_at(a, c, d);
    if (is_plane() && lower == upper) {
      tiles_.tiles.push_back({lower, {a, b, c, d}, 4});
      return;
    }
    tiles_.tiles.push_back({lower, {a, b, c}, 3});
    tiles_.tiles.push_back({upper, {a, c, d}, 3});
  }

  const TerrainSpec& terrain_;
  const contact::Terrain ground_;
  Stretch robots_x_, robots_y_;
  Cells columns_, rows_;
  GroundTiles tiles_;
};

GroundTiles tiles_of(const std::vector<StairsFace>& faces) {
  GroundTiles tiles;
  for (const StairsFace& face : faces) {
    GroundTiles::Tile& tile = tiles.tiles.emplace_back();
    tile.material = face.material;
    tile.corner_count = static_cast<int>(face.corners.size());
    std::iota(tile.corners.begin(), tile.corners.begin() + tile.corner_count,
              static_cast<int>(tiles.vertices.size()));
    tiles.vertices.insert(tiles.vertices.end(), face.corners.begin(), face.corners.end());
  }
  return tiles;
}

}  // namespace

GroundMesh grid_mesh(const GridSpec& grid, double spacing) {
  GroundMesh mesh;
  for (int row = 0; row < grid.rows; ++row)
    for (int column = 0; column < grid.columns; ++column)
      mesh.vertices.push_back(
          {grid.origin_x + column * spacing, grid.origin_y + row * spacing,
           grid.heights[static_cast<std::size_t>(row) * grid.columns + column]});
  for (int row = 0; row + 1 < grid.rows; ++row)
    for (int column = 0; column + 1 < grid.columns; ++column) {
      const int here = row * grid.columns + column;
      const int above = here + grid.columns;
      mesh.triangles.push_back({here, here + 1, above + 1});
      mesh.triangles.push_back({here, above + 1, above});
    }
  return mesh;
}

GroundTiles visible_ground(const Experiment& experiment, int most_cells) {
  if (has_risers(experiment)) return tiles_of(stairs_faces(contact::Terrain(*experiment.terrain)));
  return Tiling(experiment, most_cells).run();
}

}  // namespace hookpoint::simulation
