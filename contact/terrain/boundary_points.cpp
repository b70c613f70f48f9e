#include "contact/terrain/boundary_points.h"

#include <algorithm>
#include <numbers>

namespace hookpoint::contact {
namespace {

constexpr int default_box = 1;
constexpr int default_sphere = 4;
constexpr int default_rim = 8;

/// The density asked for, or the default for 0, and never less than what makes a shape of it.
int effective(int density, int standard, int least) {
  return density == 0 ? standard : std::max(density, least);
}

}  // namespace

std::vector<Vector3d> box_points(const Vector3d& dimensions, int density) {
  const int n = effective(density, default_box, 1);
  std::vector<Vector3d> points;
  const auto on_face = [n](int i) { return i == 0 || i == n; };
  const auto coordinate = [n](int i, double edge) {
    return edge * (static_cast<double>(i) / n - 0.5);
  };
  for (int k = 0; k <= n; ++k) {
    for (int j = 0; j <= n; ++j) {
      // Of the lattice's lines inside the box only the ends are on its surface.
      for (int i = 0; i <= n; i += on_face(j) || on_face(k) ? 1 : n) {
        points.push_back({coordinate(i, dimensions.x), coordinate(j, dimensions.y),
                          coordinate(k, dimensions.z)});
      }
    }
  }
  return points;
}

std::vector<Vector3d> sphere_points(double radius, int density) {
  const int n = effective(density, default_sphere, 2);
  std::vector<Vector3d> points{{0., 0., -radius}};
  for (int ring = 1; ring < n; ++ring) {
    const auto [s, c] = sine_cosine(std::numbers::pi * ring / n);
    for (int i = 0; i < 2 * n; ++i) {
      const auto [sine, cosine] = sine_cosine(std::numbers::pi * i / n);
      points.push_back({radius * s * cosine, radius * s * sine, -radius * c});
    }
  }
  points.push_back({0., 0., radius});
  return points;
}

std::vector<Vector3d> cylinder_points(double radius, double length, int density) {
  const int n = effective(density, default_rim, 3);
  std::vector<Vector3d> points;
  for (const double z : {-0.5 * length, 0.5 * length}) {
    if (length == 0. && !points.empty()) break;
    for (int i = 0; i < n; ++i) {
      const auto [sine, cosine] = sine_cosine(2. * std::numbers::pi * i / n);
      points.push_back({radius * cosine, radius * sine, z});
    }
  }
  return points;
}

std::vector<Vector3d> capsule_points(double radius, double length, int density) {
  const double on_equator = 1e-9 * radius;
  std::vector<Vector3d> points;
  for (const double end : {-1., 1.}) {
    for (Vector3d p : sphere_points(radius, density)) {
      if (end * p.z < -on_equator) continue;
      p.z += 0.5 * end * length;
      points.push_back(p);
    }
  }
  return points;
}

std::vector<Vector3d> legcone_points(double length, double proximal_radius, double distal_radius,
                                     int density) {
  const int n = effective(density, default_rim, 3);
  std::vector<Vector3d> points;
  const auto add_rim = [&](double x, double radius) {
    const int count = radius > 0. ? n : 1;
    for (int i = 0; i < count; ++i) {
      const auto [sine, cosine] = sine_cosine(2. * std::numbers::pi * i / count);
      points.push_back({x, radius * sine, radius * cosine});
    }
  };
  add_rim(0., proximal_radius);
  add_rim(length, distal_radius);
  return points;
}

}  // namespace hookpoint::contact
