#include "contact/geometry/round_solid.h"

#include <algorithm>
#include <cmath>
#include <limits>

namespace hookpoint::contact {
namespace {

/// A place in the half-plane through the axis of a solid with flat ends.
struct Meridian {
  double along = 0.;     ///< s, from `from` [m]
  double off_axis = 0.;  ///< [m]
  Vector3d sideways;     ///< unit, away from the axis; zero on it
};

Meridian meridian(const RoundSolid& solid, const Vector3d& place) {
  const Vector3d way = place - solid.from;
  const double along = dot(way, solid.axis);
  const Vector3d across = way - along * solid.axis;
  const double off_axis = norm(across);
  return {along, off_axis, off_axis > 0. ? (1. / off_axis) * across : Vector3d{}};
}

/// Of the outline between the ends: its length, and the normal's parts along the axis and away from it.
struct SideLine {
  double slant = 0.;  ///< [m]
  double along = 0., away = 1.;
};
SideLine side_line(const RoundSolid& solid, double length) {
  const double widening = solid.far_radius - solid.radius, slant = std::hypot(length, widening);
  if (slant == 0.) return {};
  return {slant, -widening / slant, length / slant};
}

std::optional<RoundContact> ball_on_capsule(const RoundSolid& solid, const Vector3d& center,
                                            double radius, double reach) {
  const Vector3d way = solid.to - solid.from;
  const double length = norm(way);
  const Vector3d axis = length > 0. ? (1. / length) * way : Vector3d{};
  const double s = dot(center - solid.from, axis);
  const Vector3d away = center - solid.from - std::clamp(s, 0., length) * axis;
  const double distance = norm(away), depth = radius + solid.radius - distance;
  if (distance == 0. || depth <= -reach) return std::nullopt;
  return RoundContact{(1. / distance) * away, depth, s > 0. && s < length};
}

}  // namespace

RoundEnd end_of(const RoundSolid& solid, std::size_t end) {
  return end == 0 ? RoundEnd{solid.from, -solid.axis, solid.radius}
                  : RoundEnd{solid.to, solid.axis, solid.far_radius};
}

std::optional<OverSide> over_side(const RoundSolid& solid, const Vector3d& place) {
  const Meridian at = meridian(solid, place);
  if (at.off_axis == 0.) return std::nullopt;
  const double length = solid.length();
  const SideLine side = side_line(solid, length);
  const double height = at.along * side.along + (at.off_axis - solid.radius) * side.away;
  const double foot = at.along - height * side.along;
  return OverSide{side.along * solid.axis + side.away * at.sideways, height,
                  foot >= 0. && foot <= length};
}

std::optional<RoundContact> ball_on_round(const RoundSolid& solid, const Vector3d& center,
                                          double radius, double reach) {
  if (!solid.flat_ends) return ball_on_capsule(solid, center, radius, reach);
  const double length = solid.length();
  const Meridian at = meridian(solid, center);
  const double before = -at.along, beyond = at.along - length;  // heights over the ends
  const SideLine side = side_line(solid, length);
  const double over = at.along * side.along + (at.off_axis - solid.radius) * side.away;
  const bool near_end = before > beyond;
  const double end_height = near_end ? before : beyond;
  const RoundEnd end = end_of(solid, near_end ? 0 : 1);
  const auto contact = [&](const Vector3d& normal, double height,
                           bool on_side) -> std::optional<RoundContact> {
    if (radius - height <= -reach) return std::nullopt;
    return RoundContact{normal, radius - height, on_side};
  };
  const Vector3d side_normal = side.along * solid.axis + side.away * at.sideways;
  if (end_height <= 0. && over <= 0.) {  // inside
    if (over > end_height && at.off_axis > 0.) return contact(side_normal, over, true);
    return contact(end.normal, end_height, false);
  }
  if (end_height > 0. && at.off_axis <= end.radius) return contact(end.normal, end_height, false);
  const double foot = at.along - over * side.along;
  if (over > 0. && foot > 0. && foot < length) return contact(side_normal, over, true);
  // A rim is nearest.
  const Vector3d from_rim = at.along * solid.axis + (at.off_axis - solid.radius) * at.sideways;
  const Vector3d from_far_rim =
      (at.along - length) * solid.axis + (at.off_axis - solid.far_radius) * at.sideways;
  const Vector3d& away =
      dot(from_rim, from_rim) < dot(from_far_rim, from_far_rim) ? from_rim : from_far_rim;
  const double distance = norm(away);
  if (distance == 0.) return std::nullopt;
  return contact((1. / distance) * away, distance, false);
}

std::optional<RoundContact> ball_on_disc(const RoundSolid& disc, const Vector3d& center,
                                         double radius, double reach, std::size_t came_through) {
  if (is_beside(disc, center)) return ball_on_round(disc, center, radius, reach);
  const RoundEnd end = end_of(disc, came_through);
  const double depth = radius - end.height(center);
  if (depth <= -reach) return std::nullopt;
  return RoundContact{end.normal, depth, false};
}

bool is_beside(const RoundSolid& disc, const Vector3d& place) {
  return meridian(disc, place).off_axis > disc.radius;
}

RoundSide side_of(const RoundSolid& solid) {
  const double length = solid.length();
  if (!solid.flat_ends || length == 0.) return {solid.from, solid.to, solid.radius, solid.radius};
  const double slope = (solid.far_radius - solid.radius) / length;
  const double slant = std::hypot(1., slope);
  return {solid.from + slope * solid.radius * solid.axis,
          solid.to + slope * solid.far_radius * solid.axis,
          slant * solid.radius,
          slant * solid.far_radius,
          true,
          {solid.from, solid.to}};
}

double RoundSide::depth_below_ends(const Vector3d& place) const {
  if (!flat_ends) return std::numeric_limits<double>::infinity();
  const Vector3d way = ends[1] - ends[0];
  const Vector3d axis = (1. / norm(way)) * way;
  return std::min(dot(place - ends[0], axis), dot(ends[1] - place, axis));
}

std::optional<CrossedSides> crossed_sides(const RoundSide& first, const RoundSide& second,
                                          double reach) {
  const Vector3d way_1 = first.to - first.from, way_2 = second.to - second.from;
  const double length_1 = norm(way_1), length_2 = norm(way_2);
  if (length_1 == 0. || length_2 == 0.) return std::nullopt;
  const Vector3d a = (1. / length_1) * way_1, b = (1. / length_2) * way_2;
  const double cosine = dot(a, b), sine_2 = 1. - cosine * cosine;
  constexpr double parallel = 1e-6;
  if (sine_2 < parallel) return std::nullopt;
  const double k_1 = (first.far_radius - first.radius) / length_1;
  const double k_2 = (second.far_radius - second.radius) / length_2;
  // u = x a + y b + z n.
  const double x = (k_1 + cosine * k_2) / sine_2, y = (-k_2 - cosine * k_1) / sine_2;
  const double across_2 = 1. - (x * k_1 - y * k_2);
  if (across_2 <= 0.) return std::nullopt;  // wider than the other is far: nearest at an end
  const Vector3d n = (1. / std::sqrt(sine_2)) * cross(a, b);
  const Vector3d between = first.from - second.from;
  const double apart = dot(between, n);
  if (apart == 0.) return std::nullopt;
  const double z = std::copysign(std::sqrt(across_2), apart), distance = apart / z;
  const Vector3d u = x * a + y * b + z * n;
  const Vector3d rest = distance * u - between;  // s a - t b
  const double of_a = dot(rest, a), of_b = dot(rest, b);
  const double s = (of_a - cosine * of_b) / sine_2, t = (cosine * of_a - of_b) / sine_2;
  if (s <= 0. || s >= length_1 || t <= 0. || t >= length_2) return std::nullopt;
  const double radius_1 = first.radius + k_1 * s, radius_2 = second.radius + k_2 * t;
  const double depth = radius_1 + radius_2 - distance;
  if (depth <= -reach) return std::nullopt;
  const Vector3d place = first.from + s * a - radius_1 * u, of_second = place + depth * u;
  const double weight = shorter_way(
      depth, std::min(first.depth_below_ends(of_second), second.depth_below_ends(place)));
  if (weight == 0.) return std::nullopt;
  return CrossedSides{place, {u, depth, true}, weight};
}

}  // namespace hookpoint::contact
