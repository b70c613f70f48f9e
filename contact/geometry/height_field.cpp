#include "contact/geometry/height_field.h"

#include <algorithm>
#include <cmath>

#include "contact/geometry/cell_number.h"
#include "contact/geometry/folds.h"

namespace hookpoint::contact {

HeightField::HeightField(const Terrain& terrain)
    : terrain_(&terrain),
      grid_(std::get_if<GridSurface>(&terrain.description().surface)),
      spacing_(terrain.description().spacing),
      highest_(*std::ranges::max_element(grid_->heights)),
      cell_columns_(grid_->columns - 1),
      cell_rows_(grid_->rows - 1) {}

Vector3d HeightField::vertex(std::int64_t column, std::int64_t row) const {
  return {grid_->origin_x + static_cast<double>(column) * spacing_,
          grid_->origin_y + static_cast<double>(row) * spacing_,
          grid_->heights[static_cast<std::size_t>(row * grid_->columns + column)]};
}

std::array<Vector3d, 3> HeightField::triangle(std::int64_t id) const {
  const std::int64_t cell = id / 2, column = cell % cell_columns_, row = cell / cell_columns_;
  if (id % 2 == 0)
    return {vertex(column, row), vertex(column + 1, row), vertex(column + 1, row + 1)};
  return {vertex(column, row), vertex(column + 1, row + 1), vertex(column, row + 1)};
}

// As Terrain has it: from the gradient, so that a level cell's normal is z to the last bit.
Vector3d HeightField::normal(std::int64_t id) const {
  const auto [a, b, c] = triangle(id);
  const double gradient_x = (id % 2 == 0 ? b.z - a.z : b.z - c.z) / spacing_;
  const double gradient_y = (id % 2 == 0 ? c.z - b.z : c.z - a.z) / spacing_;
  const double n_z = 1. / std::sqrt(1. + gradient_x * gradient_x + gradient_y * gradient_y);
  return {-gradient_x * n_z, -gradient_y * n_z, n_z};
}

int HeightField::material(std::int64_t id) const {
  const auto [a, b, c] = triangle(id);
  return terrain_->query((1. / 3.) * (a + b + c)).material;
}

Face HeightField::face(std::int64_t id) const {
  const std::int64_t cell = id / 2, column = cell % cell_columns_, row = cell / cell_columns_;
  const bool upper = id % 2 == 1;
  // Beyond the edges ab, bc and ca.
  const std::array<std::array<std::int64_t, 2>, 3> cells_beyond =
      upper ? std::array<std::array<std::int64_t, 2>, 3>{{{column, row},
                                                          {column, row + 1},
                                                          {column - 1, row}}}
            : std::array<std::array<std::int64_t, 2>, 3>{
                  {{column, row - 1}, {column + 1, row}, {column, row}}};
  const std::array<bool, 3> upper_beyond =
      upper ? std::array{false, false, false} : std::array{true, true, true};
  const std::array<Vector3d, 3> corners = triangle(id);
  Face face;
  face.id = id;
  face.normal = normal(id);
  face.point = corners[0];
  face.material = material(id);
  for (std::size_t k = 0; k < 3; ++k) {
    const Vector3d& from = corners[k];
    const Vector3d along = corners[(k + 1) % 3] - from;
    FaceEdge& edge = face.edges[face.edge_count++];
    edge.point = from;
    edge.outward = unit(cross(along, face.normal));
    const auto [beyond_column, beyond_row] = cells_beyond[k];
    if (!has_cell(beyond_column, beyond_row)) continue;
    edge.beyond = face_id(beyond_column, beyond_row, upper_beyond[k]);
    edge.fold = fold(edge.outward, normal(edge.beyond));
  }
  return face;
}

std::int64_t HeightField::face_at(double x, double y) const {
  const double s = (x - grid_->origin_x) / spacing_, t = (y - grid_->origin_y) / spacing_;
  const std::int64_t column = cell_number(s, cell_columns_), row = cell_number(t, cell_rows_);
  const bool upper = std::clamp(t - static_cast<double>(row), 0., 1.) >
                     std::clamp(s - static_cast<double>(column), 0., 1.);
  return face_id(column, row, upper);
}

bool HeightField::contains(const Vector3d& place) const {
  return std::isfinite(place.x) && std::isfinite(place.y) && terrain_->query(place).depth > 0.;
}

Face HeightField::nearest_face(const Vector3d& inside) const {
  return face(face_at(inside.x, inside.y));
}

// Beyond its ends the planes of the last triangles may rise higher than any vertex.
bool HeightField::is_clear_of(const Region& region) const {
  const double end_x = grid_->origin_x + spacing_ * static_cast<double>(cell_columns_);
  const double end_y = grid_->origin_y + spacing_ * static_cast<double>(cell_rows_);
  return region.low.z > highest_ && region.low.x >= grid_->origin_x && region.high.x <= end_x &&
         region.low.y >= grid_->origin_y && region.high.y <= end_y;
}

HeightField::Cells HeightField::cells(const Region& region) const {
  const auto cell = [&](double at, double origin, std::int64_t count) {
    return cell_number((at - origin) / spacing_, count);
  };
  return {cell(region.low.x, grid_->origin_x, cell_columns_),
          cell(region.high.x, grid_->origin_x, cell_columns_),
          cell(region.low.y, grid_->origin_y, cell_rows_),
          cell(region.high.y, grid_->origin_y, cell_rows_)};
}

void HeightField::faces(const Region& region, Visit<Face> visit) const {
  const Cells range = cells(region);
  for (std::int64_t row = range.first_row; row <= range.last_row; ++row) {
    for (std::int64_t column = range.first_column; column <= range.last_column; ++column) {
      for (const bool upper : {false, true}) {
        const std::int64_t id = face_id(column, row, upper);
        const auto [a, b, c] = triangle(id);
        const double top = std::max({a.z, b.z, c.z});
        const bool edge_cell = column == 0 || row == 0 || column == cell_columns_ - 1 ||
                               row == cell_rows_ - 1;  // its plane goes on
        if (edge_cell || top >= region.low.z) visit(face(id));
      }
    }
  }
}

void HeightField::visit_ridge(std::int64_t id, const Vector3d& from, const Vector3d& to,
                              std::int64_t right, std::int64_t left,
                              const Visit<Ridge>& visit) const {
  Ridge ridge;
  ridge.id = id;
  ridge.point = from;
  ridge.along = unit(to - from);
  ridge.from = 0.;
  ridge.to = norm(to - from);
  ridge.normals = {normal(right), normal(left)};
  // Out of the right face across the edge is to the left.
  ridge.outwards = {cross(ridge.normals[0], ridge.along), cross(ridge.along, ridge.normals[1])};
  if (fold(ridge.outwards[0], ridge.normals[1]) != Fold::convex) return;
  ridge.material = material(right);
  visit(ridge);
}

void HeightField::ridges(const Region& region, Visit<Ridge> visit) const {
  const Cells range = cells(region);
  for (std::int64_t row = range.first_row; row <= range.last_row + 1; ++row) {
    for (std::int64_t column = range.first_column; column <= range.last_column + 1; ++column) {
      const std::int64_t id = 3 * (row * grid_->columns + column);
      const Vector3d at = vertex(column, row);
      const auto near = [&](const Vector3d& other) {
        return std::max(at.z, other.z) >= region.low.z && std::min(at.z, other.z) <= region.high.z;
      };
      if (column < cell_columns_ && row > 0 && row < cell_rows_) {
        const Vector3d other = vertex(column + 1, row);
        if (near(other))
          visit_ridge(id, at, other, face_id(column, row - 1, true), face_id(column, row, false),
                      visit);
      }
      if (row < cell_rows_ && column > 0 && column < cell_columns_) {
        const Vector3d other = vertex(column, row + 1);
        if (near(other))
          visit_ridge(id + 1, at, other, face_id(column, row, true),
                      face_id(column - 1, row, false), visit);
      }
      if (row < cell_rows_ && column < cell_columns_) {
        const Vector3d other = vertex(column + 1, row + 1);
        if (near(other))
          visit_ridge(id + 2, at, other, face_id(column, row, false), face_id(column, row, true),
                      visit);
      }
    }
  }
}

void HeightField::corners(const Region& region, Visit<Corner> visit) const {
  const Cells range = cells(region);
  constexpr std::array<std::array<int, 2>, 6> around{
      {{1, 0}, {1, 1}, {0, 1}, {-1, 0}, {-1, -1}, {0, -1}}};
  for (std::int64_t row = std::max<std::int64_t>(range.first_row, 1);
       row <= std::min(range.last_row + 1, cell_rows_ - 1); ++row) {
    for (std::int64_t column = std::max<std::int64_t>(range.first_column, 1);
         column <= std::min(range.last_column + 1, cell_columns_ - 1); ++column) {
      Corner corner;
      corner.id = row * grid_->columns + column;
      corner.position = vertex(column, row);
      if (corner.position.z < region.low.z || corner.position.z > region.high.z) continue;
      for (const auto& [right, ahead] : around)
        corner.edges[corner.edge_count++] = vertex(column + right, row + ahead) - corner.position;
      if (!is_peak(corner)) continue;
      corner.material = terrain_->query(corner.position).material;
      visit(corner);
    }
  }
}

}  // namespace hookpoint::contact
