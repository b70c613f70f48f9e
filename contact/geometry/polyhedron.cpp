#include "contact/geometry/polyhedron.h"

#include <algorithm>
#include <array>
#include <limits>
#include <map>
#include <span>
#include <utility>

#include "contact/geometry/border.h"

namespace hookpoint::contact {
namespace {

/// Loops of at most Face::most_edges vertices.
std::vector<Polyhedron::Loop> small_loops(const std::vector<Polyhedron::Loop>& loops) {
  std::vector<Polyhedron::Loop> small;
  for (const Polyhedron::Loop& loop : loops) {
    if (loop.size() <= Face::most_edges) {
      small.push_back(loop);
      continue;
    }
    for (std::size_t i = 2; i < loop.size(); ++i) small.push_back({loop[0], loop[i - 1], loop[i]});
  }
  return small;
}

/// The box about places and what counts as on them.
Region region_of(std::span<const Vector3d> places) {
  const auto [low, high] = region_about(places);
  const Vector3d width{edge_width, edge_width, edge_width};
  return {low - width, high + width};
}

}  // namespace

Polyhedron::Polyhedron(std::vector<Vector3d> vertices, const std::vector<Loop>& loops)
    : vertices_(std::move(vertices)), bounds_(region_of(vertices_)) {
  const std::vector<Loop> polygons = small_loops(loops);
  std::map<std::pair<std::size_t, std::size_t>, std::int64_t> face_of_edge;
  for (const Loop& loop : polygons) {
    Face face;
    face.id = static_cast<std::int64_t>(faces_.size());
    face.point = vertices_[loop[0]];
    face.normal = unit(cross(vertices_[loop[1]] - vertices_[loop[0]],
                             vertices_[loop.back()] - vertices_[loop[0]]));
    for (std::size_t k = 0; k < loop.size(); ++k)
      face_of_edge[{loop[k], loop[(k + 1) % loop.size()]}] = face.id;
    faces_.push_back(face);
  }
  std::map<std::size_t, Corner> corners;
  for (std::size_t f = 0; f < polygons.size(); ++f) {
    const Loop& loop = polygons[f];
    Face& face = faces_[f];
    for (std::size_t k = 0; k < loop.size(); ++k) {
      const std::size_t from = loop[k], to = loop[(k + 1) % loop.size()];
      const Vector3d along = vertices_[to] - vertices_[from];
      FaceEdge& edge = face.edges[face.edge_count++];
      edge.point = vertices_[from];
      edge.outward = unit(cross(along, face.normal));
      edge.beyond = face_of_edge.at({to, from});
      const Vector3d& normal_beyond = faces_[static_cast<std::size_t>(edge.beyond)].normal;
      edge.fold = fold(edge.outward, normal_beyond);
      if (edge.fold == Fold::flat) continue;
      Corner& corner = corners[from];
      if (corner.edge_count < Corner::most_edges) corner.edges[corner.edge_count++] = along;
      if (face.id > edge.beyond) continue;
      Ridge ridge;
      ridge.id = static_cast<std::int64_t>(ridges_.size());
      ridge.point = vertices_[from];
      ridge.along = unit(along);
      ridge.from = 0.;
      ridge.to = norm(along);
      ridge.normals = {face.normal, normal_beyond};
      ridge.outwards = {edge.outward, unit(cross(normal_beyond, along))};
      ridges_.push_back(ridge);
      ridge_regions_.push_back(region_of(std::array{vertices_[from], vertices_[to]}));
      ends_.push_back({from, to});
    }
  }
  thickness_ = std::numeric_limits<double>::max();
  for (const Face& face : faces_) {
    double farthest = 0.;
    for (const Vector3d& vertex : vertices_) farthest = std::max(farthest, -face.height(vertex));
    thickness_ = std::min(thickness_, farthest);
  }
  for (auto& [vertex, corner] : corners) {
    corner.id = static_cast<std::int64_t>(vertex);
    corner.position = vertices_[vertex];
    corners_.push_back(corner);
  }
}

Polyhedron Polyhedron::box(const Vector3d& dimensions) {
  std::vector<Vector3d> vertices;
  for (const double z : {-0.5, 0.5})
    for (const double y : {-0.5, 0.5})
      for (const double x : {-0.5, 0.5})
        vertices.push_back({x * dimensions.x, y * dimensions.y, z * dimensions.z});
  return {std::move(vertices), box_loops()};
}

const std::vector<Polyhedron::Loop>& Polyhedron::box_loops() {
  static const std::vector<Loop> loops{{0, 2, 3, 1}, {4, 5, 7, 6}, {0, 1, 5, 4},
                                       {2, 6, 7, 3}, {0, 4, 6, 2}, {1, 3, 7, 5}};
  return loops;
}

bool Polyhedron::contains(const Vector3d& place) const {
  // A place on the border counts: corners that lie flush with a face have to touch something.
  return std::ranges::all_of(faces_,
                             [&](const Face& face) { return face.height(place) < edge_width; });
}

Face Polyhedron::nearest_face(const Vector3d& inside) const {
  return *std::ranges::max_element(faces_, {},
                                   [&](const Face& face) { return face.height(inside); });
}

// On the border of a face against which it points it only touches. On another it may still be under a face
// beside, as the corners of a box are that stands flush on another; it is under none where all are far.
std::int64_t Polyhedron::face_over(const Vector3d& inside, const Vector3d& outward) const {
  if (touched_face(*this, inside, outward)) return -1;
  const auto below = [&](const Face& face) {
    const double height = face.height(inside);
    return height < -edge_width ? height : -std::numeric_limits<double>::max();
  };
  const Face& nearest = *std::ranges::max_element(faces_, {}, below);
  const bool is_on_border = nearest_face(inside).height(inside) >= -edge_width;
  return is_on_border && -nearest.height(inside) > 0.02 * thickness_ ? -1 : nearest.id;
}

void Polyhedron::faces(const Region& /*region*/, Visit<Face> visit) const {
  for (const Face& face : faces_) visit(face);
}

void Polyhedron::ridges(const Region& region, Visit<Ridge> visit) const {
  for (std::size_t i = 0; i < ridges_.size(); ++i)
    if (overlap(ridge_regions_[i], region)) visit(ridges_[i]);
}

void Polyhedron::corners(const Region& /*region*/, Visit<Corner> visit) const {
  for (const Corner& corner : corners_) visit(corner);
}

}  // namespace hookpoint::contact
