#include "simulation/scene/urdf/hull.h"

#include <algorithm>
#include <cerrno>
#include <cmath>
#include <cstdio>
#include <limits>
#include <memory>
#include <new>
#include <system_error>

extern "C" {
#include <libqhull_r/qhull_ra.h>
}

namespace hookpoint::simulation {
namespace {

/// Which of the points, three coordinates each between -1 and 1, are vertices; all where Qhull
/// finds none, as of points in a plane.
std::vector<bool> vertices_among(std::vector<double>& coordinates) {
  const std::size_t count = coordinates.size() / 3;
  std::vector<bool> chosen(count, false);
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
      chosen[static_cast<std::size_t>((vertex->point - coordinates.data()) / 3)] = true;
  } else {
    chosen.assign(count, true);
  }
  qh_freeqhull(qh, qh_ALL);
  int kept = 0, total = 0;
  qh_memfreeshort(qh, &kept, &total);
  if (failed == qh_ERRmem) throw std::bad_alloc();
  return chosen;
}

}  // namespace

Bounds bounds_of(std::span<const Vector3d> points) {
  Bounds bounds{points[0], points[0]};
  auto& [low, high] = bounds;
  for (const Vector3d& p : points) {
    low = {std::min(low.x, p.x), std::min(low.y, p.y), std::min(low.z, p.z)};
    high = {std::max(high.x, p.x), std::max(high.y, p.y), std::max(high.z, p.z)};
  }
  return bounds;
}

std::vector<Vector3d> hull_vertices(std::span<const Vector3d> points) {
  constexpr std::size_t simplex = 4;
  if (points.size() <= simplex) return {points.begin(), points.end()};
  const auto [low, high] = bounds_of(points);
  const Vector3d middle = 0.5 * (low + high), edges = high - low;
  const double size = 0.5 * std::max({edges.x, edges.y, edges.z});
  std::vector<double> coordinates;
  coordinates.reserve(3 * points.size());
  for (const Vector3d& p : points) {
    const Vector3d q = (1. / size) * (p - middle);
    coordinates.insert(coordinates.end(), {q.x, q.y, q.z});
  }
  const std::vector<bool> chosen = vertices_among(coordinates);
  std::vector<Vector3d> vertices;
  for (std::size_t i = 0; i < points.size(); ++i) {
    if (chosen[i]) vertices.push_back(points[i]);
  }
  return vertices;
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
