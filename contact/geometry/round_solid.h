// Solids of revolution as what others touch: balls, capsules, cylinders, truncated cones, discs.
#pragma once

#include <algorithm>
#include <array>
#include <cstddef>
#include <optional>

#include "math/vector3.h"

namespace hookpoint::contact {

/// All places within `radius` of the line from `from` to `to`: a capsule, a ball where they are one
/// place. With `flat_ends` it is cut off there, and its radius goes evenly over to `far_radius`: a
/// cylinder, a truncated cone, and where they are one place a disc without thickness.
struct RoundSolid {
  Vector3d from, to;       ///< [m]
  double radius = 0.;      ///< at `from` [m]
  double far_radius = 0.;  ///< at `to`; a capsule's is `radius` [m]
  Vector3d axis;           ///< unit, from `from` to `to`; of a ball any
  bool flat_ends = false;

  double length() const { return norm(to - from); }
  bool is_disc() const { return flat_ends && length() == 0.; }
};

/// A flat end: 0 at `from`, 1 at `to`.
struct RoundEnd {
  Vector3d center;     ///< [m]
  Vector3d normal;     ///< unit, out of the solid
  double radius = 0.;  ///< [m]

  double height(const Vector3d& place) const { return dot(place - center, normal); }
};
RoundEnd end_of(const RoundSolid& solid, std::size_t end);

/// Of a place beside the axis of a solid with flat ends: the side's normal there, and the height over
/// it, < 0 inside [m].
struct OverSide {
  Vector3d normal;      ///< unit
  double height = 0.;   ///< over the cone or cylinder of which the side is a part [m]
  bool within = false;  ///< whether the nearest place of that lies between the ends
};
/// None on the axis, where no way out is the nearest.
std::optional<OverSide> over_side(const RoundSolid& solid, const Vector3d& place);

struct RoundContact {
  Vector3d normal;       ///< unit, out of the solid
  double depth = 0.;     ///< of the other ball's surface [m]
  bool on_side = false;  ///< between the ends
};

/// A ball of `radius` [m], 0 of a point, about `center`. None farther than `reach` [m] off, or in the
/// very middle, where no way out is the nearest.
std::optional<RoundContact> ball_on_round(const RoundSolid& solid, const Vector3d& center,
                                          double radius, double reach);

/// The same against a disc, which has no inside: it is left by the end through which the centre came, 0
/// or 1. Beside the disc its rim is nearest, whichever end that was.
std::optional<RoundContact> ball_on_disc(const RoundSolid& disc, const Vector3d& center,
                                         double radius, double reach, std::size_t came_through);
/// Whether a place lies beside a disc, over neither of its ends.
bool is_beside(const RoundSolid& disc, const Vector3d& place);

/// A side of a solid of revolution as the envelope of balls about its axis: that of a ball goes evenly
/// from `radius` at `from` to `far_radius` at `to`.
struct RoundSide {
  Vector3d from, to;       ///< [m]
  double radius = 0.;      ///< [m]
  double far_radius = 0.;  ///< [m]
  bool flat_ends = false;
  std::array<Vector3d, 2> ends{};  ///< centres of the flat ends [m]

  /// How far a place is below the nearer flat end [m], < 0 beyond it; infinity where there is none.
  double depth_below_ends(const Vector3d& place) const;
};
/// Of a truncated cone, or a cylinder, whose radii at its ends are those. A ball about c touches the
/// side at s = c - m r(s), m = dr/ds, with the radius r sqrt(1 + m^2).
RoundSide side_of(const RoundSolid& solid);

/// What a contact with a depth counts where its bodies also part by moving `other` [m] over an edge or
/// an end that is near: 1 where that is farther, falling to 0 where it is half as far. Of two ways out
/// of a solid the shorter is the one that it was entered by.
inline double shorter_way(double depth, double other) {
  if (depth <= 0.) return other > 0. ? 1. : 0.;
  return std::clamp(2. * other / depth - 1., 0., 1.);
}

/// Two round sides that cross, seen from the second: none where their axes are parallel or nearest at
/// an end, where balls and rims touch. With u from the second's axis to the first's, and k the growth
/// of a radius along an axis e, the depth is greatest where u . e_1 = k_1 and u . e_2 = -k_2.
struct CrossedSides {
  Vector3d place;  ///< on the first one's surface [m]
  RoundContact contact;
  double weight = 1.;  ///< from 0 to 1: less where they part over a flat end as well
};
std::optional<CrossedSides> crossed_sides(const RoundSide& first, const RoundSide& second,
                                          double reach);

}  // namespace hookpoint::contact
