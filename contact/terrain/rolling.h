// A boundary point with a radius: a ball about a centre, which touches the ground where its surface
// faces the tile. The place that touches wanders over the ball as it rolls, and a hook must not
// feel that: only the slip of the ball's material over the ground stretches it (docs/contact.md).
#pragma once

#include "math/rotation.h"
#include "math/vector3.h"

namespace hookpoint::contact {

/// What a ball's hook is remembered with.
struct BallFrame {
  Quaterniond orientation;  ///< R_WB of the ball's body
  Vector3d normal;          ///< n of the tile under its centre
};

/// phi of a rotation exp(phi), the shortest, world axes [rad].
inline Vector3d rotation_vector(const Quaterniond& rotation) {
  const double sign = rotation.w < 0. ? -1. : 1.;
  const Vector3d sine = sign * Vector3d{rotation.x, rotation.y, rotation.z};
  const double length = norm(sine);
  if (length == 0.) return {};
  return (2. * std::atan2(length, sign * rotation.w) / length) * sine;
}

/// How far rolling carries the hook of a ball of radius r [m] from the frame `from` to the frame
/// `to`, world axes [m]. The touching place is x = c - r n, so that it moves by
///   dx = dc - r dn,
/// the material there slips over the ground by
///   ds = dc + phi x (-r n),     phi the rotation (exact for a steady turn),
/// and the hook moves by the difference dx - ds = r phi x n - r dn: the stretch x - h then changes
/// by ds alone. Pure, O(1).
inline Vector3d rolling_displacement(const BallFrame& from, const BallFrame& to, double radius) {
  const Vector3d phi = rotation_vector(to.orientation * conjugate(from.orientation));
  return radius * (cross(phi, to.normal) - (to.normal - from.normal));
}

}  // namespace hookpoint::contact
