// A ball, or a point, against a surface.
//
// While its centre c is outside the solid a ball of radius r touches where a place q of the surface
// is nearest to c of all places round about q: on a face, on a ridge or in a corner. The normal is
// (c - q)/|c - q| and the depth r - |c - q|.
//
// A centre inside the solid, as a point is that touches, stays with the faces through which it came
// in until it is out again: the depth is r - h, h < 0 the height over a face's plane. Across a flat
// edge the face beyond follows; across a concave one the plane continues and the face beyond joins
// in; at a blunt convex edge the nearer of the two faces holds (there they are equally near, so that
// the depth is continuous), and a sharp one is left outwards only.
//
// concurrent.h says what part of the way out each place gives.
#pragma once

#include <array>
#include <cstdint>
#include <span>

#include "contact/geometry/concurrent.h"
#include "contact/geometry/surface.h"

namespace hookpoint::contact {

/// The faces that hold a centre inside the solid; none while it is outside.
struct Holding {
  static constexpr std::size_t most = 3;
  std::array<std::int64_t, most> faces{};
  std::size_t count = 0;
};

/// Where it touches.
struct SurfaceContact {
  Vector3d normal;    ///< unit, out of the surface
  double depth = 0.;  ///< > 0 [m]
  double part = 1.;   ///< of the way out that is this contact's (Obstruction)
  int material = 0;
};

struct BallContacts {
  std::array<SurfaceContact, most_obstructions> contacts;
  std::size_t count = 0;
  Holding holding;  ///< of this state

  std::span<const SurfaceContact> all() const& { return std::span(contacts).first(count); }
  std::span<const SurfaceContact> all() const&& = delete;  // it would outlive what it shows
};

/// The face under which a place inside lies, at most `most_depth` [m] deep, whose normal is nearest to
/// `normal`; -1 where none is within 45 degrees. O(faces there).
std::int64_t face_along(const Surface& surface, const Vector3d& inside, const Vector3d& normal,
                        double most_depth);

/// Of a ball of `radius` [m], 0 of a point, at `center`, that was at `before` with `held` (outside
/// if none): both in the surface's frame. Contacts are those with a depth over -`reach` [m]. `outward`, unit,
/// points out of the shape that it is part of; zero of a whole ball and of a lone point. The ball at the end
/// of a capsule meets a corner with its half beyond the end, for beside it the capsule's side does. A corner
/// that is flush with an edge comes in through the face that its shape lies beyond (border.h). O(faces near
/// it), allocates nothing.
BallContacts ball_on_surface(const Surface& surface, const Vector3d& center, double radius,
                             const Vector3d& before, const Holding& held, double reach,
                             const Vector3d& outward = {});

}  // namespace hookpoint::contact
