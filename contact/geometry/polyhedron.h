// A convex polyhedron as a surface: a box, a hull.
#pragma once

#include <vector>

#include "contact/geometry/surface.h"

namespace hookpoint::contact {

class Polyhedron final : public Surface {
 public:
  /// A face: its vertices, counter-clockwise as seen from outside.
  using Loop = std::vector<std::size_t>;

  /// The loops close the solid. A face with more than four vertices is cut into triangles, whose
  /// common edges are flat.
  Polyhedron(std::vector<Vector3d> vertices, const std::vector<Loop>& loops);
  /// Centred, with those edge lengths [m].
  static Polyhedron box(const Vector3d& dimensions);
  /// The faces of a box, of the vertices that box() makes in their order.
  static const std::vector<Loop>& box_loops();

  bool contains(const Vector3d& place) const override;
  bool is_clear_of(const Region& region) const override { return !overlap(bounds_, region); }
  Face face(std::int64_t id) const override { return faces_[static_cast<std::size_t>(id)]; }
  Face nearest_face(const Vector3d& inside) const override;
  std::int64_t face_over(const Vector3d& inside, const Vector3d& outward) const override;
  void faces(const Region& region, Visit<Face> visit) const override;
  void ridges(const Region& region, Visit<Ridge> visit) const override;
  void corners(const Region& region, Visit<Corner> visit) const override;

  const std::vector<Vector3d>& vertices() const { return vertices_; }
  const std::vector<Ridge>& all_ridges() const { return ridges_; }
  /// The vertices at the ends of a ridge.
  std::array<std::size_t, 2> ends(std::size_t ridge) const { return ends_[ridge]; }

 private:
  std::vector<Vector3d> vertices_;
  Region bounds_;
  double thickness_ = 0.;  ///< least distance of a vertex from a face opposite to it [m]
  std::vector<Face> faces_;
  std::vector<Ridge> ridges_;
  std::vector<Region> ridge_regions_;  ///< the box about each
  std::vector<std::array<std::size_t, 2>> ends_;
  std::vector<Corner> corners_;
};

}  // namespace hookpoint::contact
