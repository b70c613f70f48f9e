#include "simulation/scene/urdf/mesh_shape.h"

#include <fmt/format.h>

#include <algorithm>

#include "contact/geometry/surface.h"
#include "simulation/scene/urdf/hull.h"
#include "simulation/scene/urdf/mesh_path.h"

namespace hookpoint::simulation {

const MeshPoints* find_mesh(const std::string& filename, const language::Position& at,
                            const std::filesystem::path& robot, language::FileStore& files,
                            UrdfXml& xml) {
  const std::vector<std::filesystem::path> places =
      mesh_places(filename, robot, files.search_path());
  if (places.empty()) {
    xml.fail(at, filename.empty()
                     ? "this <mesh> has no filename"
                     : "a mesh is named by a path, or by package://NAME/PATH or file://PATH");
    return nullptr;
  }
  const std::filesystem::path found = first_file(places);
  if (found.empty()) {
    std::string tried;
    for (const std::filesystem::path& path : places)
      tried += fmt::format("{}{}", tried.empty() ? "" : ", ", path.string());
    xml.fail(at, fmt::format("there is no mesh `{}`: looked for {} (HOOKPOINT_PATH names further "
                             "folders; meshes = skip does without)",
                             filename, tried));
    return nullptr;
  }
  const std::string path = found.string();
  const MeshPoints& mesh = files.keep<MeshPoints>("mesh " + path, [&] { return read_mesh(found); });
  if (mesh.problem.empty()) return &mesh;
  xml.fail(at, fmt::format("the mesh {} cannot be read: {}", path, mesh.problem));
  return nullptr;
}

void add_mesh(std::span<const Vector3d> vertices, const Vector3d& scale, UrdfMeshes as,
              const Pose& X_LS, const language::Position& place, const std::string& material,
              UrdfLink& link, std::map<std::string, std::size_t>& left_out) {
  std::vector<Vector3d> points;
  for (const Vector3d& p : vertices)
    points.push_back({scale.x * p.x, scale.y * p.y, scale.z * p.z});
  if (as == UrdfMeshes::box) {
    const auto [low, high] = contact::region_about(points);
    // A flat mesh is a plate.
    constexpr double thinnest = 1e-6;  // [m]
    const Vector3d edges = high - low;
    const Box box{
        {std::max(edges.x, thinnest), std::max(edges.y, thinnest), std::max(edges.z, thinnest)}};
    const Pose X_LB = X_LS * Pose{0.5 * (low + high), {}};
    link.shapes.push_back({{box, X_LB.position, X_LB.orientation, 0}, place, true, material});
    return;
  }
  const std::vector<Vector3d> hull = hull_vertices(points);
  const std::vector<Vector3d> taken = spread_points(hull, most_hull_points);
  if (taken.size() < hull.size())
    left_out[fmt::format("vertex of a hull, beyond {} of it", most_hull_points)] +=
        hull.size() - taken.size();
  for (const Vector3d& p : taken)
    link.points.push_back({(X_LS * Pose{p, {}}).position, place, material});
}

}  // namespace hookpoint::simulation
