#include <algorithm>
#include <array>
#include <cmath>
#include <cstdint>
#include <map>
#include <set>
#include <span>
#include <utility>
#include <vector>

#include "simulation/ground.h"
#include "simulation/run/shown_scene.h"

namespace hookpoint::simulation {
namespace {

constexpr double margin = 20.;                  ///< of a plane without an edge [m]
constexpr std::size_t most_cells = 256;         ///< along a side of a grid
constexpr double most_mixed_cells = 1U << 16U;  ///< of a plane, in one stretch

/// Tiles as triangles, each with those of its material.
class Tiles {
 public:
  explicit Tiles(const contact::Terrain& ground) : ground_(ground) {}

  /// The material of the tile at a point within it.
  int material(double x, double y) const { return ground_.query(x, y, 0.).material; }
  Vector3d vertex(double x, double y) const { return {x, y, ground_.query(x, y, 0.).height}; }

  /// Convex, counter-clockwise; corners may coincide with the next.
  void add(int material, const std::array<Vector3d, 4>& corners) {
    output::SceneSurface& surface = surfaces_[material];
    std::array<std::uint32_t, 4> indices{};
    std::size_t count = 0;
    for (const Vector3d& corner : corners) {
      const std::uint32_t index = index_of(material, surface, corner);
      const auto seen = std::span(indices).first(count);
      const bool again = std::ranges::find(seen, index) != seen.end();
      if (!again) indices[count++] = index;
    }
    for (std::size_t i = 2; i < count; ++i)
      surface.triangles.push_back({indices[0], indices[i - 1], indices[i]});
  }

  /// By material.
  std::map<int, output::SceneSurface> take() { return std::move(surfaces_); }

 private:
  std::uint32_t index_of(int material, output::SceneSurface& surface, const Vector3d& corner) {
    const auto [at, is_new] = indices_.try_emplace(
        {material, corner.x, corner.y}, static_cast<std::uint32_t>(surface.vertices.size()));
    if (is_new) surface.vertices.push_back(corner);
    return at->second;
  }

  struct Place {
    int material;
    double x, y;
    auto operator<=>(const Place&) const = default;
  };
  const contact::Terrain& ground_;
  std::map<int, output::SceneSurface> surfaces_;
  std::map<Place, std::uint32_t> indices_;
};

/// Cells of a plane along x or y, by their whole numbers: [first, last), the last one cut at `end`.
struct Cells {
  double origin = 0., spacing = 1., first = 0., end = 0., last = 0.;

  /// `size`: of a terrain, centred; 0 is without an edge, from `least` to `most`.
  Cells(double cell, double size, double least, double most)
      : origin(-0.5 * size), spacing(cell), end(size / cell) {
    if (size == 0.) {
      first = std::floor(least / cell);
      end = std::ceil(most / cell);
    }
    last = std::ceil(end);
  }
  double at(double cell) const { return origin + std::min(cell, end) * spacing; }

  /// Where the materials may change. A patch's edge is in a cell whose two tiles have their
  /// centroids on either side of it, or both on one: that cell stands by itself.
  std::vector<double> breaks(const std::vector<double>& edges) const {
    std::set<double> breaks{first, last};
    for (const double edge : edges) {
      const double cell = std::clamp(std::floor((edge - origin) / spacing), first, last);
      breaks.insert({cell, std::min(cell + 1., last)});
    }
    return {breaks.begin(), breaks.end()};
  }
};

class Plane {
 public:
  Plane(const Cells& columns, const Cells& rows, Tiles& tiles)
      : columns_(columns), rows_(rows), tiles_(tiles) {}

  /// Cells that are alike: one material for the lower tiles, one for the upper.
  void add(double c0, double c1, double r0, double r1) {
    const int lower = material_of(c0 + 2. / 3., r0 + 1. / 3.);
    const int upper = material_of(c0 + 1. / 3., r0 + 2. / 3.);
    if (lower == upper || (c1 - c0) * (r1 - r0) > most_mixed_cells)
      return tiles_.add(lower, {at(c0, r0), at(c1, r0), at(c1, r1), at(c0, r1)});
    for (double row = r0; row < r1; ++row)
      for (double column = c0; column < c1; ++column) add_cell(column, row, lower, upper);
  }

 private:
  /// The two tiles of a cell, on either side of its diagonal, cut where the plane ends.
  void add_cell(double c, double r, int lower, int upper) {
    const double c_end = std::min(c + 1., columns_.end), r_end = std::min(r + 1., rows_.end);
    const double diagonal = std::min(c_end - c, r_end - r);
    const Vector3d far = at(c + diagonal, r + diagonal);
    tiles_.add(lower, {at(c, r), at(c_end, r), at(c_end, r + diagonal), far});
    tiles_.add(upper, {at(c, r), far, at(c + diagonal, r_end), at(c, r_end)});
  }
  int material_of(double column, double row) const {
    return tiles_.material(columns_.origin + column * columns_.spacing,
                           rows_.origin + row * rows_.spacing);
  }
  Vector3d at(double column, double row) const {
    return tiles_.vertex(columns_.at(column), rows_.at(row));
  }

  const Cells& columns_;
  const Cells& rows_;
  Tiles& tiles_;
};

/// Of a plane without an edge: from the least to the greatest of the values, wider by the margin.
std::pair<double, double> reach(const std::vector<double>& values) {
  if (values.empty()) return {-margin, margin};
  const auto [least, most] = std::ranges::minmax(values);
  return {least - margin, most + margin};
}

void add_plane(const Experiment& experiment, Tiles& tiles) {
  const TerrainSpec& terrain = *experiment.terrain;
  std::vector<double> patch_xs, patch_ys;
  for (const contact::MaterialPatch& patch : terrain.patches) {
    patch_xs.insert(patch_xs.end(), {patch.from_x, patch.to_x});
    patch_ys.insert(patch_ys.end(), {patch.from_y, patch.to_y});
  }
  std::vector<double> xs = patch_xs, ys = patch_ys;
  for (const RobotSpec& robot : experiment.robots) {
    xs.push_back(robot.location.x);
    ys.push_back(robot.location.y);
  }
  const auto [least_x, most_x] = reach(xs);
  const auto [least_y, most_y] = reach(ys);
  const Cells columns(terrain.spacing, terrain.size_x, least_x, most_x);
  const Cells rows(terrain.spacing, terrain.size_y, least_y, most_y);
  const std::vector<double> across = columns.breaks(patch_xs), along = rows.breaks(patch_ys);
  Plane plane(columns, rows, tiles);
  for (std::size_t r = 1; r < along.size(); ++r)
    for (std::size_t c = 1; c < across.size(); ++c)
      plane.add(across[c - 1], across[c], along[r - 1], along[r]);
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
    tiles.add(tiles.material((a.x + b.x + c.x) / 3., (a.y + b.y + c.y) / 3.), {a, b, c, c});
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
  if (const auto* grid = std::get_if<contact::GridSurface>(&terrain.surface)) {
    add_grid(*grid, terrain.spacing, tiles);
  } else {
    add_plane(experiment, tiles);
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
