// Where a rigid body touches a plane with points and balls, and whether it can roll there.
//
// The contacts lie at x_i = c_i - r_i n: c_i the centre of a ball of radius r_i (0 of a point), n
// the normal of the plane. Without slip the material at every x_i is at rest along the plane, and
// since the centres stay r_i above the plane it is at rest along n, too. The body turns at w, so
// that of any two contacts w x (x_i - x_j) = 0: w is parallel to the line that joins them. Contacts
// on one line let the body roll about that line, as a cylinder does, or as a cone where the balls
// differ. Three contacts that are not on one line leave w = 0: the body slips or rests, as on
// points at x_i.
#pragma once

#include <algorithm>
#include <cstddef>
#include <limits>
#include <span>
#include <vector>

#include "math/vector3.h"

namespace hookpoint::contact {

/// A point of a body, or the ball about it; positions are world axes.
struct Foot {
  Vector3d position;      ///< of the centre; in a Footprint of its contact [m]
  double radius = 0.;     ///< of the ball; 0 of a point [m]
  std::size_t index = 0;  ///< among all feet of the body
};

struct Footprint {
  std::vector<Foot> feet;  ///< that touch

  /// Whether all contacts lie on one line; true of one or two.
  bool in_line() const {
    constexpr double straight = 1e-6;  // [m]
    const auto from_first = [&](const Foot& foot) { return foot.position - feet.front().position; };
    Vector3d farthest;
    for (const Foot& foot : feet)
      if (norm(from_first(foot)) > norm(farthest)) farthest = from_first(foot);
    const double length = norm(farthest);
    return length == 0. || std::ranges::all_of(feet, [&](const Foot& foot) {
             return norm(cross(from_first(foot), farthest)) <= straight * length;
           });
  }
  /// Whether the body can roll.
  bool rolls() const {
    return in_line() &&
           std::ranges::any_of(feet, [](const Foot& foot) { return foot.radius > 0.; });
  }
};

/// The lowest contacts along `normal`, and those that are higher by no more than `level` [m].
inline Footprint footprint_of(std::span<const Foot> feet, const Vector3d& normal,
                              double level = 1e-6) {
  Footprint footprint;
  double lowest = std::numeric_limits<double>::infinity();
  const auto height = [&](const Foot& foot) { return dot(foot.position, normal) - foot.radius; };
  for (const Foot& foot : feet) lowest = std::min(lowest, height(foot));
  for (const Foot& foot : feet)
    if (height(foot) - lowest <= level)
      footprint.feet.push_back({foot.position - foot.radius * normal, foot.radius, foot.index});
  return footprint;
}

}  // namespace hookpoint::contact
