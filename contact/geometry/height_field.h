// A grid of heights as a surface: two triangles a cell, as Terrain has them.
#pragma once

#include "contact/geometry/surface.h"
#include "contact/terrain/terrain.h"

namespace hookpoint::contact {

/// Faces: 2 (row columns + column) is the half of that cell right of its diagonal, one more the half
/// left of it. Ridges: 3 (row columns + column) and the two that follow are the edges that leave that
/// vertex along x, along y and along the diagonal. Beyond the grid's ends the planes of its last
/// triangles continue.
class HeightField final : public Surface {
 public:
  /// `terrain` has a grid and outlives the surface.
  explicit HeightField(const Terrain& terrain);

  bool contains(const Vector3d& place) const override;
  Face face(std::int64_t id) const override;
  bool is_rough() const override { return true; }
  Face nearest_face(const Vector3d& inside) const override;
  bool is_clear_of(const Region& region) const override;
  void faces(const Region& region, Visit<Face> visit) const override;
  void ridges(const Region& region, Visit<Ridge> visit) const override;
  void corners(const Region& region, Visit<Corner> visit) const override;

 private:
  struct Cells {
    std::int64_t first_column, last_column, first_row, last_row;
  };
  Cells cells(const Region& region) const;
  Vector3d vertex(std::int64_t column, std::int64_t row) const;
  /// Three vertices of a triangle, counter-clockwise from above, the first at the cell's lower left.
  std::array<Vector3d, 3> triangle(std::int64_t id) const;
  Vector3d normal(std::int64_t id) const;
  std::int64_t face_at(double x, double y) const;
  std::int64_t face_id(std::int64_t column, std::int64_t row, bool upper) const {
    return 2 * (row * cell_columns_ + column) + (upper ? 1 : 0);
  }
  bool has_cell(std::int64_t column, std::int64_t row) const {
    return column >= 0 && row >= 0 && column < cell_columns_ && row < cell_rows_;
  }
  void visit_ridge(std::int64_t id, const Vector3d& from, const Vector3d& to, std::int64_t right,
                   std::int64_t left, const Visit<Ridge>& visit) const;
  int material(std::int64_t id) const;

  const Terrain* terrain_;
  const GridSurface* grid_;
  double spacing_;
  double highest_;  ///< vertex [m]
  std::int64_t cell_columns_, cell_rows_;
};

}  // namespace hookpoint::contact
