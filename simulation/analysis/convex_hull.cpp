#include "simulation/analysis/convex_hull.h"

#include <algorithm>
#include <cmath>

namespace hookpoint::simulation {
namespace {

Vector3d unit(const Vector3d& v) { return (1. / norm(v)) * v; }

/// The point for which `measure` is greatest.
template <class Measure>
std::size_t farthest(std::span<const Vector3d> points, const Measure& measure) {
  std::size_t best = 0;
  for (std::size_t i = 1; i < points.size(); ++i) {
    if (measure(points[i]) > measure(points[best])) best = i;
  }
  return best;
}

/// A plane that has all points on its inner side, and one of them on it.
struct Plane {
  Vector3d normal;  ///< unit, outwards
  Vector3d point;   ///< any of it [m]
};

class Wrapping {
 public:
  Wrapping(std::span<const Vector3d> points, double tolerance)
      : points_(points),
        tolerance_(tolerance),
        most_faces_(std::clamp<std::size_t>(most_looks / points.size(), 50, 20000)) {
    const Vector3d& first = points[0];
    const auto along = [&](const Vector3d& p) { return norm(p - first); };
    const Vector3d far = points[farthest(points, along)] - first;
    size_ = norm(far);
    near_ = 1e-9 * size_;
    if (size_ == 0.) return;
    const Vector3d line = unit(far);
    const auto across = [&](const Vector3d& p) { return norm(tangential(p - first, line)); };
    const Vector3d aside = tangential(points[farthest(points, across)] - first, line);
    if (norm(aside) <= near_) return;
    flat_normal_ = unit(cross(line, aside));
    const auto above = [&](const Vector3d& p) { return std::abs(dot(p - first, flat_normal_)); };
    is_flat_ = above(points[farthest(points, above)]) <= near_;
    is_line_ = false;
  }

  std::vector<HullFace> faces() {
    if (is_line_) return {{{}, on_plane({{}, points_[0]}, size_)}};
    if (is_flat_) {
      for (const Vector3d& normal : {flat_normal_, -flat_normal_})
        faces_.push_back({normal, on_plane({normal, points_[0]}, tolerance_)});
      return std::move(faces_);
    }
    add(first_face());
    for (std::size_t i = 0; i < planes_.size() && planes_.size() < most_faces_; ++i) {
      const std::vector<std::size_t> corners = polygon(planes_[i]);
      for (std::size_t j = 0; j < corners.size(); ++j) {
        const Vector3d& from = points_[corners[j]];
        const Vector3d& to = points_[corners[(j + 1) % corners.size()]];
        add(turned(planes_[i], from, unit(to - from), near_));
      }
    }
    return std::move(faces_);
  }

 private:
  /// Points times faces: a rounded body of more has its first faces alone, and a bound from them.
  static constexpr std::size_t most_looks = 20'000'000;

  std::vector<std::size_t> on_plane(const Plane& plane, double within) const {
    std::vector<std::size_t> on;
    for (std::size_t i = 0; i < points_.size(); ++i) {
      if (std::abs(dot(points_[i] - plane.point, plane.normal)) <= within) on.push_back(i);
    }
    return on;
  }

  /// The plane turned inwards about the line from `from` along `edge`, away from what lies to the
  /// left of it (seen from outside), until it meets a point that is `off` [m] from the plane.
  Plane turned(const Plane& plane, const Vector3d& from, const Vector3d& edge, double off) const {
    const Vector3d beyond = cross(edge, plane.normal);
    double least = HUGE_VAL;
    for (const Vector3d& p : points_) {
      const double x = dot(p - from, beyond), y = -dot(p - from, plane.normal);
      if (std::abs(y) <= off && x <= near_) continue;  // of the face, or on the line
      if (x * x + y * y <= near_ * near_) continue;
      least = std::min(least, std::atan2(std::max(0., y), x));
    }
    if (!std::isfinite(least)) return plane;
    return {std::sin(least) * beyond + std::cos(least) * plane.normal, from};
  }

  Plane first_face() const {
    const std::size_t lowest = farthest(points_, [](const Vector3d& p) { return -p.z; });
    const Plane below{{0., 0., -1.}, points_[lowest]};
    const Plane touching = turned(below, below.point, {1., 0., 0.}, near_);
    // About the line to another point of that plane, or about any line in it.
    const std::size_t other = farthest(points_, [&](const Vector3d& p) {
      const bool on = std::abs(dot(p - below.point, touching.normal)) <= near_;
      return on ? norm(p - below.point) : 0.;
    });
    const Vector3d edge = unit(points_[other] - below.point);
    const Plane face = turned(touching, below.point, edge, near_);
    return has_area(face) ? face : turned(touching, below.point, -edge, near_);
  }

  bool has_area(const Plane& plane) const { return polygon(plane).size() > 2; }

  void add(const Plane& plane) {
    const auto same = [&](const Plane& other) {
      return norm(other.normal - plane.normal) < 1e-6 &&
             std::abs(dot(other.point - plane.point, plane.normal)) <= 1e-6 * size_;
    };
    // Each edge turns up twice: most planes are known, which costs less to see than an area.
    if (std::ranges::any_of(planes_, same) || !has_area(plane)) return;
    planes_.push_back(plane);
    faces_.push_back({plane.normal, on_plane(plane, tolerance_)});
  }

  /// The corners of a face, counterclockwise seen from outside (Andrew's monotone chain).
  std::vector<std::size_t> polygon(const Plane& plane) const {
    std::vector<std::size_t> on = on_plane(plane, 1e-8 * size_);
    const Vector3d least_axis =
        std::abs(plane.normal.x) < 0.6 ? Vector3d{1., 0., 0.} : Vector3d{0., 1., 0.};
    const Vector3d u = unit(tangential(least_axis, plane.normal)), v = cross(plane.normal, u);
    const auto x = [&](std::size_t i) { return dot(points_[i], u); };
    const auto y = [&](std::size_t i) { return dot(points_[i], v); };
    std::ranges::sort(
        on, [&](std::size_t a, std::size_t b) { return x(a) != x(b) ? x(a) < x(b) : y(a) < y(b); });
    std::vector<std::size_t> corners;
    const auto add_side = [&](auto first, auto last) {
      const std::size_t start = corners.size();
      for (; first != last; ++first) {
        while (corners.size() >= start + 2) {
          const std::size_t a = corners[corners.size() - 2], b = corners.back();
          const double area =
              (x(b) - x(a)) * (y(*first) - y(a)) - (y(b) - y(a)) * (x(*first) - x(a));
          if (area > near_ * size_) break;
          corners.pop_back();
        }
        corners.push_back(*first);
      }
      corners.pop_back();
    };
    if (on.size() < 3) return on;
    add_side(on.begin(), on.end());
    add_side(on.rbegin(), on.rend());
    return corners;
  }

  std::span<const Vector3d> points_;
  double tolerance_;  ///< [m]
  std::size_t most_faces_;
  double size_ = 0.;  ///< of all points together [m]
  double near_ = 0.;  ///< nearer than that is on a line or a plane [m]
  bool is_line_ = true, is_flat_ = false;
  Vector3d flat_normal_;
  std::vector<Plane> planes_;
  std::vector<HullFace> faces_;
};

}  // namespace

std::vector<HullFace> hull_faces(std::span<const Vector3d> points, double tolerance) {
  if (points.empty()) return {};
  return Wrapping(points, tolerance).faces();
}

}  // namespace hookpoint::simulation
