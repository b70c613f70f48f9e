// Balls, capsules and cylinders as what others touch.
#pragma once

#include <optional>

#include "math/vector3.h"

namespace hookpoint::contact {

/// All places within `radius` of the line from `from` to `to`: a capsule, a ball where they are one
/// place; with `flat_ends` cut off there: a cylinder.
struct RoundSolid {
  Vector3d from, to;
  double radius = 0.;
  bool flat_ends = false;
};

struct RoundContact {
  Vector3d normal;       ///< unit, out of the solid
  double depth = 0.;     ///< of the other ball's surface [m]
  bool on_side = false;  ///< between the ends
};

/// A ball of `radius` [m], 0 of a point, about `center`. None farther than `reach` [m] off, or in the
/// very middle, where no way out is the nearest.
std::optional<RoundContact> ball_on_round(const RoundSolid& solid, const Vector3d& center,
                                          double radius, double reach);

/// Two round sides that cross, seen from the second: none where their axes are parallel or nearest at
/// an end, where balls and rims touch.
struct CrossedAxes {
  Vector3d place;  ///< on the first one's surface [m]
  RoundContact contact;
};
std::optional<CrossedAxes> crossed_axes(const RoundSolid& first, const RoundSolid& second,
                                        double reach);

}  // namespace hookpoint::contact
