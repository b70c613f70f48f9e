#include "contact/terrain/terrain.h"

#include <algorithm>
#include <cassert>
#include <cmath>
#include <limits>
#include <sstream>

namespace hookpoint::contact {
namespace {

std::string surface_problem(const FlatSurface& flat) {
  return std::isfinite(flat.height) ? "" : "the height of a flat terrain must be finite";
}

std::string surface_problem(const SlopeSurface& slope) {
  if (!std::isfinite(slope.azimuth)) return "the azimuth of a slope must be finite";
  const bool below_vertical = slope.angle >= 0. && std::cos(slope.angle) > 1e-6;
  return below_vertical && slope.angle < 1.6
             ? ""
             : "the angle of a slope must be from 0 to below 90 deg";
}

std::string surface_problem(const GridSurface& grid) {
  if (grid.columns < 2 || grid.rows < 2) return "a grid needs at least 2 x 2 heights";
  const std::size_t wanted = static_cast<std::size_t>(grid.columns) * grid.rows;
  if (grid.heights.size() != wanted) {
    std::ostringstream text;
    text << "a grid of " << grid.columns << " x " << grid.rows << " vertices needs " << wanted
         << " heights, got " << grid.heights.size();
    return text.str();
  }
  for (const double height : grid.heights) {
    if (!std::isfinite(height)) return "the heights of a grid must be finite";
  }
  if (!std::isfinite(grid.origin_x) || !std::isfinite(grid.origin_y)) {
    return "the origin of a grid must be finite";
  }
  return "";
}

/// The cell that holds coordinate `s` (in cells) out of `count`, clamped to the edge cells; the
/// first for not-a-number, which then shows in the depth.
double clamped_cell(double s, double count) {
  return std::min(count - 1., std::max(0., std::floor(s)));
}

}  // namespace

std::string Terrain::problem(const TerrainDescription& description) {
  if (!(description.spacing > 0.) || !std::isfinite(description.spacing)) {
    return "the spacing of a terrain must be positive";
  }
  const bool sized = description.size_x >= 0. && description.size_y >= 0. &&
                     std::isfinite(description.size_x) && std::isfinite(description.size_y);
  if (!sized) return "the size of a terrain must not be negative (0: unbounded)";
  return std::visit([](const auto& surface) { return surface_problem(surface); },
                    description.surface);
}

Terrain::Terrain(TerrainDescription description) : description_(std::move(description)) {
  assert(problem(description_).empty());
  if (const auto* grid = std::get_if<GridSurface>(&description_.surface)) {
    origin_x_ = grid->origin_x;
    origin_y_ = grid->origin_y;
    columns_ = grid->columns - 1;
    rows_ = grid->rows - 1;
    measure(*grid);
    if (description_.patches.empty()) return;
    tile_materials_.reserve(2 * static_cast<std::size_t>(columns_ * rows_));
    for (double row = 0.; row < rows_; ++row) {
      for (double column = 0.; column < columns_; ++column) {
        for (const bool upper : {false, true}) {
          tile_materials_.push_back(painted_material({column, row, upper, false}));
        }
      }
    }
    return;
  }
  if (const auto* slope = std::get_if<SlopeSurface>(&description_.surface)) {
    gradient_x_ = -std::tan(slope->angle) * std::cos(slope->azimuth);
    gradient_y_ = -std::tan(slope->angle) * std::sin(slope->azimuth);
  }
  normal_ = normal_of(gradient_x_, gradient_y_);
  // An unbounded plane is tiled from the world's origin in all directions; a bounded one from its
  // lower left corner.
  unbounded_x_ = description_.size_x == 0.;
  unbounded_y_ = description_.size_y == 0.;
  origin_x_ = -0.5 * description_.size_x;
  origin_y_ = -0.5 * description_.size_y;
  columns_ = description_.size_x / description_.spacing;
  rows_ = description_.size_y / description_.spacing;
}

Terrain::Tile Terrain::tile_at(double x, double y) const {
  const double s = (x - origin_x_) / description_.spacing;
  const double t = (y - origin_y_) / description_.spacing;
  Tile tile;
  tile.outside =
      (!unbounded_x_ && !(s >= 0. && s <= columns_)) || (!unbounded_y_ && !(t >= 0. && t <= rows_));
  tile.column = unbounded_x_ ? std::floor(s) : clamped_cell(s, std::ceil(columns_));
  tile.row = unbounded_y_ ? std::floor(t) : clamped_cell(t, std::ceil(rows_));
  tile.upper = min(max(t - tile.row, 0.), 1.) > min(max(s - tile.column, 0.), 1.);
  return tile;
}

Terrain::Plane Terrain::plane_of(const Tile& tile, double x, double y) const {
  if (const auto* flat = std::get_if<FlatSurface>(&description_.surface)) {
    return {flat->height, normal_};
  }
  if (std::holds_alternative<SlopeSurface>(description_.surface)) {
    return {gradient_x_ * x + gradient_y_ * y, normal_};
  }
  const auto& grid = *std::get_if<GridSurface>(&description_.surface);
  const double spacing = description_.spacing;
  const std::size_t columns = static_cast<std::size_t>(grid.columns);
  const std::size_t corner =
      static_cast<std::size_t>(tile.row) * columns + static_cast<std::size_t>(tile.column);
  const double h00 = grid.heights[corner];
  const double h10 = grid.heights[corner + 1];
  const double h01 = grid.heights[corner + columns];
  const double h11 = grid.heights[corner + columns + 1];
  const double gradient_x = (tile.upper ? h11 - h01 : h10 - h00) / spacing;
  const double gradient_y = (tile.upper ? h01 - h00 : h11 - h10) / spacing;
  return {h00 + gradient_x * (x - (origin_x_ + tile.column * spacing)) +
              gradient_y * (y - (origin_y_ + tile.row * spacing)),
          normal_of(gradient_x, gradient_y)};
}

int Terrain::painted_material(const Tile& tile) const {
  // The centroid of (0,0) (1,0) (1,1) is (2/3, 1/3); of (0,0) (1,1) (0,1) it is (1/3, 2/3).
  const double s = tile.column + (tile.upper ? 1. / 3. : 2. / 3.);
  const double t = tile.row + (tile.upper ? 2. / 3. : 1. / 3.);
  const double x = origin_x_ + s * description_.spacing;
  const double y = origin_y_ + t * description_.spacing;
  int material = description_.material;
  for (const MaterialPatch& patch : description_.patches) {
    const bool in_x = x >= min(patch.from_x, patch.to_x) && x <= max(patch.from_x, patch.to_x);
    const bool in_y = y >= min(patch.from_y, patch.to_y) && y <= max(patch.from_y, patch.to_y);
    if (in_x && in_y) material = patch.material;
  }
  return material;
}

int Terrain::material_of(const Tile& tile) const {
  if (description_.patches.empty()) return description_.material;
  if (tile_materials_.empty()) return painted_material(tile);
  const double index = 2. * (tile.row * columns_ + tile.column) + (tile.upper ? 1. : 0.);
  return tile_materials_[static_cast<std::size_t>(index)];
}

Vector3d Terrain::normal_of(double gradient_x, double gradient_y) {
  const double n_z = 1. / std::sqrt(1. + gradient_x * gradient_x + gradient_y * gradient_y);
  return {-gradient_x * n_z, -gradient_y * n_z, n_z};
}

TilePoint Terrain::point_on(const Plane& plane, const Vector3d& point) const {
  TilePoint result;
  result.normal = plane.normal;
  result.depth = (plane.height - point.z) * plane.normal.z;
  result.height = plane.height;
  result.material = description_.material;
  return result;
}

TilePoint Terrain::query(const Vector3d& point) const {
  const bool one_tile = unbounded_x_ && unbounded_y_ && description_.patches.empty();
  if (one_tile) return point_on(plane_of({}, point.x, point.y), point);
  const Tile tile = tile_at(point.x, point.y);
  TilePoint result = point_on(plane_of(tile, point.x, point.y), point);
  result.material = material_of(tile);
  result.outside = tile.outside;
  return result;
}

void Terrain::measure(const GridSurface& grid) {
  highest_ = *std::ranges::max_element(grid.heights);
  const std::size_t columns = static_cast<std::size_t>(grid.columns);
  double rise_x = 0., rise_y = 0.;
  for (std::size_t i = 0; i < grid.heights.size(); ++i) {
    if ((i + 1) % columns != 0)
      rise_x = std::max(rise_x, std::abs(grid.heights[i + 1] - grid.heights[i]));
    if (i + columns < grid.heights.size())
      rise_y = std::max(rise_y, std::abs(grid.heights[i + columns] - grid.heights[i]));
  }
  least_normal_z_ = normal_of(rise_x / description_.spacing, rise_y / description_.spacing).z;
}

// depth = (h - z) n_z with h <= highest, and 0 < least n_z <= n_z where h < z.
double Terrain::deepest_over_grid(const Vector3d& center, const Vector3d& reach) const {
  const double over = center.z - reach.z - highest_;
  const double s = center.x - origin_x_, t = center.y - origin_y_;
  const double width = columns_ * description_.spacing, length = rows_ * description_.spacing;
  const bool within = s >= reach.x && s <= width - reach.x && t >= reach.y && t <= length - reach.y;
  return over > 0. && within ? -over * least_normal_z_ : std::numeric_limits<double>::infinity();
}

// The corner that lies deepest is as far below the centre as the normal's part along each edge
// says.
double Terrain::deepest(const Vector3d& center, const Matrix3d& R_WB, const Vector3d& half) const {
  if (std::holds_alternative<GridSurface>(description_.surface))
    return deepest_over_grid(
        center,
        {std::abs(R_WB.xx) * half.x + std::abs(R_WB.xy) * half.y + std::abs(R_WB.xz) * half.z,
         std::abs(R_WB.yx) * half.x + std::abs(R_WB.yy) * half.y + std::abs(R_WB.yz) * half.z,
         std::abs(R_WB.zx) * half.x + std::abs(R_WB.zy) * half.y + std::abs(R_WB.zz) * half.z});
  if (!unbounded_x_ || !unbounded_y_) return std::numeric_limits<double>::infinity();
  const TilePoint tile = point_on(plane_of({}, center.x, center.y), center);
  const Vector3d n = transpose_times(R_WB, tile.normal);
  return tile.depth + std::abs(n.x) * half.x + std::abs(n.y) * half.y + std::abs(n.z) * half.z;
}

std::string Terrain::outside_message(const Vector3d& point) const {
  const double end_x = origin_x_ + columns_ * description_.spacing;
  const double end_y = origin_y_ + rows_ * description_.spacing;
  std::ostringstream text;
  text << "a boundary point at x = " << point.x << " m, y = " << point.y
       << " m has left the terrain";
  if (!unbounded_x_) text << ", which reaches in x from " << origin_x_ << " to " << end_x << " m";
  if (!unbounded_y_) text << ", which reaches in y from " << origin_y_ << " to " << end_y << " m";
  text << "; the plane of its edge tile is continued";
  return text.str();
}

TilePose Terrain::pose_on_tile(double x, double y, double yaw) const {
  TilePose pose;
  pose.tile = query(x, y, 0.);
  pose.position = {x, y, pose.tile.height};
  // The shortest rotation from z to n: half-angle quaternion (1 + z.n, z x n), normalised. n_z > 0,
  // so it exists.
  const Vector3d& n = pose.tile.normal;
  const Quaterniond tilt = normalized(Quaterniond{1. + n.z, -n.y, n.x, 0.});
  pose.orientation = tilt * exponential(Vector3d{0., 0., yaw});
  return pose;
}

}  // namespace hookpoint::contact
