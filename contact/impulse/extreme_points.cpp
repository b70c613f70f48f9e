#include "contact/impulse/extreme_points.h"

#include <algorithm>
#include <cmath>

namespace hookpoint::contact {
namespace {

constexpr double edge_rounding = 1e-9;  // of the extent

}  // namespace

std::size_t keep_extreme(std::span<PlanePoint> points, std::span<PlanePoint> corners) {
  if (points.size() < 2) return points.size();
  double extent = 0.;
  for (const PlanePoint& point : points)
    extent = std::max(extent, std::hypot(point.x - points[0].x, point.y - points[0].y));
  const double slack = edge_rounding * extent;
  // By x, of those alike by y: rounding is not to say which is first of a column.
  std::sort(points.begin(), points.end(), [](const PlanePoint& a, const PlanePoint& b) {
    return a.x != b.x ? a.x < b.x : a.y < b.y;
  });
  for (std::size_t first = 0; first < points.size();) {
    std::size_t end = first + 1;
    while (end < points.size() && points[end].x - points[end - 1].x <= slack) ++end;
    std::sort(points.begin() + static_cast<std::ptrdiff_t>(first),
              points.begin() + static_cast<std::ptrdiff_t>(end),
              [](const PlanePoint& a, const PlanePoint& b) { return a.y < b.y; });
    first = end;
  }
  std::size_t count = 0;
  const auto turns_left = [&](const PlanePoint& next) {
    const PlanePoint& a = corners[count - 2];
    const PlanePoint& b = corners[count - 1];
    const double length = std::hypot(next.x - a.x, next.y - a.y);
    return (b.x - a.x) * (next.y - a.y) - (b.y - a.y) * (next.x - a.x) > slack * length;
  };
  const auto add = [&](const PlanePoint& next, std::size_t least) {
    if (count > 0 &&
        std::hypot(next.x - corners[count - 1].x, next.y - corners[count - 1].y) <= slack)
      return;
    while (count >= least && !turns_left(next)) --count;
    corners[count++] = next;
  };
  for (const PlanePoint& point : points) add(point, 2);
  const std::size_t lower = count + 1;
  for (std::size_t i = points.size(); i-- > 0;) add(points[i], lower);
  // The walk ends where it began.
  if (count > 1) --count;
  std::copy_n(corners.begin(), count, points.begin());
  return count;
}

}  // namespace hookpoint::contact
