// The rim of a cylinder, a cone or a disc against a solid of revolution: a tin on a tin, or on a log.
#pragma once

#include <algorithm>
#include <array>
#include <cstddef>
#include <span>

#include "contact/geometry/rim.h"
#include "contact/geometry/round_solid.h"

namespace hookpoint::contact {

/// A rim as that of a shape.
struct ShapeRim {
  Rim rim;
  Vector3d middle;  ///< of the shape; a disc's is the rim's centre [m]

  bool is_disc() const { return rim.center == middle; }
  /// Whether the shape is outside of a face over which its middle is at `height`, where the other solid
  /// is `half_thickness` thick below it: a disc that lies on it is all below it [m].
  bool is_over(double height, double half_thickness) const {
    return height > (is_disc() ? -std::min(rim.radius, half_thickness) : 0.);
  }
  /// Unit, out of the flat end that meets the shape's side in the rim; of a disc, which has two ends,
  /// out of that against which `normal` presses.
  Vector3d end_against(const Vector3d& normal) const {
    const double side = dot(rim.center - middle, rim.axis);
    return side > 0. || (side == 0. && dot(normal, rim.axis) < 0.) ? rim.axis : -rim.axis;
  }
};

struct RimContact {
  /// Which of the places that a rim may have: a point of it on an end, where it crosses the rim of an
  /// end, on the side.
  enum class Kind { end, rim, side };
  Kind kind = Kind::end;
  std::size_t end = 0;  ///< of the solid, but for a side's
  /// Of its point on an end. Places of the other kinds are not numbered: where one begins or ends the others
  /// stay what they are.
  std::size_t number = 0;
  Vector3d place;      ///< on the rim [m]
  Vector3d normal;     ///< unit, out of the solid
  double depth = 0.;   ///< > 0 where they overlap [m]
  double weight = 1.;  ///< from 0 to 1
};

/// Two circles have four places in common at most, and a circle two places next to a side.
struct RimContacts {
  static constexpr std::size_t most = 2 * (rim_points + 4) + 2;
  std::array<RimContact, most> contacts;
  std::size_t count = 0;

  void add(const RimContact& contact) {
    if (count < most) contacts[count++] = contact;
  }
  std::span<const RimContact> all() const& { return std::span(contacts).first(count); }
  std::span<const RimContact> all() const&& = delete;  // it would outlive what it shows
};

/// Of a disc, which has no inside: the end over which the other shape came, and whether it has come
/// under it since.
struct CameOver {
  std::size_t end = 0;
  bool held = false;
};

/// With a depth above -`reach` [m]:
/// - the points of the rim that are deepest under a flat end over which its shape is, where they are
///   over that end (deepest_points); of a disc under the end that it came over alone, through that end and not round its rim;
/// - `with_rims`: where the rim and the end's rim are nearest to each other as they cross, fading out as
///   the two run alongside, and as the normal leaves the faces that meet in them;
/// - the places of the rim nearest to the side, where the normal there lies between the faces that meet
///   in the rim.
RimContacts rim_on_round(const RoundSolid& solid, const ShapeRim& shape, double reach,
                         bool with_rims, const CameOver& of_a_disc = {});

}  // namespace hookpoint::contact
