#include "simulation/scene/urdf/hull.h"

#include <algorithm>
#include <cerrno>
#include <cmath>
#include <cstdio>
#include <limits>
#include <memory>
#include <new>
#include <set>
#include <system_error>
#include <utility>

extern "C" {
#include <libqhull_r/qhull_ra.h>
}

#include "contact/geometry/surface.h"

namespace hookpoint::simulation {
namespace {

/// What Qhull says of points.
struct FoundHull {
  std::vector<bool> vertices;  ///< of each point; all where no solid was found
  std::vector<std::vector<std::size_t>> faces;
};

/// The points of a facet in their order around it, counter-clockwise as seen from outside.
std::vector<std::size_t> points_of(qhT* qh, facetT* facet, const std::vector<double>& coordinates) {
  std::vector<std::size_t> face;
  setT* vertices = qh_facet3vertex(qh, facet);
  for (int i = 0; i < qh_setsize(qh, vertices); ++i) {
    const auto* vertex = static_cast<const vertexT*>(vertices->e[i].p);
    face.push_back(static_cast<std::size_t>((vertex->point - coordinates.data()) / 3));
  }
  qh_settempfree(qh, &vertices);
  Vector3d area;
  const auto at = [&](std::size_t i) {
    const double* p = &coordinates[3 * face[i]];
    return Vector3d{p[0], p[1], p[2]};
  };
  for (std::size_t i = 2; i < face.size(); ++i) area += cross(at(i - 1) - at(0), at(i) - at(0));
  if (dot(area, {facet->normal[0], facet->normal[1], facet->normal[2]}) < 0.)
    std::ranges::reverse(face);
  return face;
}

/// Of points with three coordinates each between -1 and 1.
FoundHull find_hull(std::vector<double>& coordinates) {
  const std::size_t count = coordinates.size() / 3;
  FoundHull found{std::vector<bool>(count, false), {}};
  const std::unique_ptr<std::FILE, int (*)(std::FILE*)> nowhere(std::fopen("/dev/null", "w"),
                                                                std::fclose);
  if (nowhere == nullptr)
    throw std::system_error(errno, std::generic_category(), "cannot open /dev/null");
  const auto qhull = std::make_unique<qhT>();
  qhT* qh = qhull.get();
  qh_zero(qh, nowhere.get());
  char command[] = "qhull W1e-6";
  const int failed = qh_new_qhull(qh, 3, static_cast<int>(count), coordinates.data(), False,
                                  command, nowhere.get(), nowhere.get());
  if (failed == 0) {
    for (const vertexT* vertex = qh->vertex_list; vertex != nullptr && vertex->next != nullptr;
         vertex = vertex->next)
      found.vertices[static_cast<std::size_t>((vertex->point - coordinates.data()) / 3)] = true;
    for (facetT* facet = qh->facet_list; facet != nullptr && facet->next != nullptr;
         facet = facet->next)
      found.faces.push_back(points_of(qh, facet, coordinates));
  } else {
    found.vertices.assign(count, true);
  }
  qh_freeqhull(qh, qh_ALL);
  int kept = 0, total = 0;
  qh_memfreeshort(qh, &kept, &total);
  if (failed == qh_ERRmem) throw std::bad_alloc();
  return found;
}

/// Scaled to the cube between -1 and 1 of their bounds.
std::vector<double> hull_coordinates(std::span<const Vector3d> points) {
  const auto [low, high] = contact::region_about(points);
  const Vector3d middle = 0.5 * (low + high), edges = high - low;
  const double size = 0.5 * std::max({edges.x, edges.y, edges.z});
  std::vector<double> coordinates;
  coordinates.reserve(3 * points.size());
  for (const Vector3d& p : points) {
    const Vector3d q = (1. / size) * (p - middle);
    coordinates.insert(coordinates.end(), {q.x, q.y, q.z});
  }
  return coordinates;
}

/// Whether each edge of a face is one of another face, the other way round.
bool closed(const std::vector<std::vector<std::size_t>>& faces) {
  std::set<std::pair<std::size_t, std::size_t>> edges;
  for (const std::vector<std::size_t>& face : faces)
    for (std::size_t i = 0; i < face.size(); ++i)
      if (!edges.insert({face[i], face[(i + 1) % face.size()]}).second) return false;
  return std::ranges::all_of(edges, [&](const auto& edge) {
    return edges.contains({edge.second, edge.first});
  });
}

}  // namespace

std::vector<Vector3d> hull_vertices(std::span<const Vector3d> points) {
  constexpr std::size_t simplex = 4;
  if (points.size() <= simplex) return {points.begin(), points.end()};
  std::vector<double> coordinates = hull_coordinates(points);
  const std::vector<bool> chosen = find_hull(coordinates).vertices;
  std::vector<Vector3d> vertices;
  for (std::size_t i = 0; i < points.size(); ++i) {
    if (chosen[i]) vertices.push_back(points[i]);
  }
  return vertices;
}

Hull convex_hull(std::span<const Vector3d> points) {
  constexpr std::size_t simplex = 4;
  if (points.size() < simplex) return {{points.begin(), points.end()}, {}};
  std::vector<double> coordinates = hull_coordinates(points);
  FoundHull found = find_hull(coordinates);
  Hull hull;
  std::vector<std::size_t> places(points.size());
  for (std::size_t i = 0; i < points.size(); ++i) {
    places[i] = hull.vertices.size();
    if (found.vertices[i]) hull.vertices.push_back(points[i]);
  }
  if (!closed(found.faces)) return hull;
  hull.faces = std::move(found.faces);
  for (std::vector<std::size_t>& face : hull.faces)
    for (std::size_t& vertex : face) vertex = places[vertex];
  std::ranges::sort(hull.faces);
  return hull;
}

Vector3d face_normal(const Hull& hull, const std::vector<std::size_t>& face) {
  Vector3d area;
  for (std::size_t i = 2; i < face.size(); ++i)
    area += cross(hull.vertices[face[i - 1]] - hull.vertices[face[0]],
                  hull.vertices[face[i]] - hull.vertices[face[0]]);
  return (1. / norm(area)) * area;
}

std::vector<Vector3d> spread_points(std::span<const Vector3d> points, std::size_t most) {
  if (points.size() <= most) return {points.begin(), points.end()};
  std::vector<double> squares(points.size(), std::numeric_limits<double>::infinity());
  std::vector<bool> taken(points.size(), false);
  std::size_t count = 0;
  const auto take = [&](std::size_t i) {
    if (taken[i] || count == most) return;
    taken[i] = true;
    ++count;
    for (std::size_t k = 0; k < points.size(); ++k) {
      const Vector3d apart = points[k] - points[i];
      squares[k] = std::min(squares[k], dot(apart, apart));
    }
  };
  for (int x = -1; x <= 1; ++x) {
    for (int y = -1; y <= 1; ++y) {
      for (int z = -1; z <= 1; ++z) {
        const Vector3d along{double(x), double(y), double(z)};
        const auto out = [&](const Vector3d& p) { return dot(p, along); };
        if (x != 0 || y != 0 || z != 0)
          take(
              static_cast<std::size_t>(std::ranges::max_element(points, {}, out) - points.begin()));
      }
    }
  }
  while (count < most)
    take(static_cast<std::size_t>(std::ranges::max_element(squares) - squares.begin()));
  std::vector<Vector3d> chosen;
  for (std::size_t i = 0; i < points.size(); ++i) {
    if (taken[i]) chosen.push_back(points[i]);
  }
  return chosen;
}

}  // namespace hookpoint::simulation
