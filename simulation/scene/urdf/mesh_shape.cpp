#include "simulation/scene/urdf/mesh_shape.h"

#include <fmt/format.h>

#include <algorithm>

#include "simulation/scene/urdf/hull.h"

namespace hookpoint::simulation {

void add_mesh(std::span<const Vector3d> vertices, const Vector3d& scale, UrdfMeshes as,
              const Pose& X_LS, const language::Position& place, UrdfLink& link,
              std::map<std::string, std::size_t>& left_out) {
  std::vector<Vector3d> points;
  for (const Vector3d& p : vertices)
    points.push_back({scale.x * p.x, scale.y * p.y, scale.z * p.z});
  if (as == UrdfMeshes::box) {
    const auto [low, high] = bounds_of(points);
    // A flat mesh is a plate.
    constexpr double thinnest = 1e-6;  // [m]
    const Vector3d edges = high - low;
    const Box box{
        {std::max(edges.x, thinnest), std::max(edges.y, thinnest), std::max(edges.z, thinnest)}};
    const Pose X_LB = X_LS * Pose{0.5 * (low + high), {}};
    link.shapes.push_back({{box, X_LB.position, X_LB.orientation, 0}, place, true, ""});
    return;
  }
  const std::vector<Vector3d> hull = hull_vertices(points);
  const std::vector<Vector3d> taken = spread_points(hull, most_hull_points);
  if (taken.size() < hull.size())
    left_out[fmt::format("vertex of a hull, beyond {} of it", most_hull_points)] +=
        hull.size() - taken.size();
  for (const Vector3d& p : taken) {
    link.points.push_back(X_LS.position + rotate(X_LS.orientation, p));
    link.point_places.push_back(place);
  }
}

}  // namespace hookpoint::simulation
