#include "contact/geometry/round_solid.h"

#include <algorithm>
#include <cmath>

namespace hookpoint::contact {

std::optional<RoundContact> ball_on_round(const RoundSolid& solid, const Vector3d& center,
                                          double radius, double reach) {
  const Vector3d way = solid.to - solid.from;
  const double length = norm(way);
  const Vector3d axis = length > 0. ? (1. / length) * way : Vector3d{};
  const double s = dot(center - solid.from, axis);
  const bool on_side = s > 0. && s < length;
  const double within = std::clamp(s, 0., length);
  const Vector3d from_axis = center - solid.from - within * axis;

  Vector3d away;  // from the solid's core to the centre
  double core = solid.radius;
  if (!solid.flat_ends) {
    away = from_axis;
  } else {
    const Vector3d across = center - solid.from - s * axis;
    const double off_axis = norm(across);
    const double beyond = s < 0.5 * length ? -s : s - length;  // of the nearer end
    const Vector3d out = s < 0.5 * length ? -axis : axis;
    const Vector3d sideways = off_axis > 0. ? (1. / off_axis) * across : Vector3d{};
    const double over = off_axis - solid.radius;
    if (beyond <= 0. && over > beyond && off_axis > 0.) {
      away = across;  // the side is nearest
    } else if (over <= 0.) {
      return beyond < radius + reach ? std::optional(RoundContact{out, radius - beyond, false})
                                     : std::nullopt;
    } else {
      away = beyond * out + over * sideways;  // the rim is
      core = 0.;
    }
  }
  const double distance = norm(away);
  const double depth = radius + core - distance;
  if (distance == 0. || depth <= -reach) return std::nullopt;
  return RoundContact{(1. / distance) * away, depth, on_side};
}

std::optional<CrossedAxes> crossed_axes(const RoundSolid& first, const RoundSolid& second,
                                        double reach) {
  const Vector3d way_1 = first.to - first.from, way_2 = second.to - second.from;
  const double length_1 = norm(way_1), length_2 = norm(way_2);
  if (length_1 == 0. || length_2 == 0.) return std::nullopt;
  const Vector3d a = (1. / length_1) * way_1, b = (1. / length_2) * way_2;
  const double cosine = dot(a, b), sine_2 = 1. - cosine * cosine;
  constexpr double parallel = 1e-6;
  if (sine_2 < parallel) return std::nullopt;
  const Vector3d between = second.from - first.from;
  const double s = (dot(between, a) - cosine * dot(between, b)) / sine_2;
  const double t = (cosine * dot(between, a) - dot(between, b)) / sine_2;
  if (s <= 0. || s >= length_1 || t <= 0. || t >= length_2) return std::nullopt;
  const Vector3d away = first.from + s * a - (second.from + t * b);
  const double distance = norm(away), depth = first.radius + second.radius - distance;
  if (distance == 0. || depth <= -reach) return std::nullopt;
  const Vector3d normal = (1. / distance) * away;
  return CrossedAxes{first.from + s * a - first.radius * normal, {normal, depth, true}};
}

}  // namespace hookpoint::contact
