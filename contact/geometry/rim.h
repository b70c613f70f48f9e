// The rim of a disc, of a cylinder's or a cone's end, against a plane.
#pragma once

#include <array>

#include "math/vector3.h"

namespace hookpoint::contact {

/// A circle about `center` [m] in the plane across `axis`, a unit vector.
struct Rim {
  Vector3d center;
  Vector3d axis;
  double radius = 0.;  ///< [m]
  Vector3d reference;  ///< unit, across the axis; turns with the body
};

inline constexpr std::size_t rim_points = 3;
/// Sine of the angle between axis and normal below which a rim is level.
inline constexpr double level_rim = 1e-12;

/// Where a rim presses on a plane of unit normal n: its point that reaches deepest, and those a third
/// of a turn from it to either side. `center_depth` d0 is that of its centre [m].
///
/// With a = r sin(angle between axis and n) the depths are d0 + a cos(phi), phi = 0, +-120 deg. The
/// springs of the three hold 3/2 k d0^2 + 3/4 k a^2 while all touch, whichever way the deepest point
/// lies: a rim that lies flat resists tilting alike about all axes, and one that rolls touches in its
/// deepest point alone, which moves along it. Where the rim is level there is no deepest point; there
/// the three fall back to a place that turns with the body, which changes no force while all touch.
inline std::array<Vector3d, rim_points> deepest_points(const Rim& rim, const Vector3d& normal,
                                                       double center_depth) {
  const Vector3d down = dot(normal, rim.axis) * rim.axis - normal;  // its length is a/r
  const double a = rim.radius * norm(down);
  const double level = center_depth > 0. ? max(0., 1. - a / center_depth) : 0.;
  Vector3d deepest = rim.radius * down + (center_depth * level * level) * rim.reference;
  // Of a level rim `down` is rounding, and of one that is nearly level it is hardly across the axis.
  if (norm(deepest) <= level_rim * rim.radius) deepest = rim.reference;
  deepest = tangential((1. / norm(deepest)) * deepest, rim.axis);
  const Vector3d e1 = (1. / norm(deepest)) * deepest;
  const Vector3d e2 = cross(rim.axis, e1);
  constexpr double cosine = -0.5, sine = 0.8660254037844386;  // of 120 deg
  return {rim.center + rim.radius * e1, rim.center + rim.radius * (cosine * e1 + sine * e2),
          rim.center + rim.radius * (cosine * e1 - sine * e2)};
}

}  // namespace hookpoint::contact
