// Corners on the border of a solid: flush with an edge or a corner of it, where by its place alone a corner
// may lie on several faces.
#pragma once

#include <optional>

#include "contact/geometry/folds.h"

namespace hookpoint::contact {

/// Whether a place lies on the plane of a face to rounding.
inline bool on_border(const Face& face, const Vector3d& place) {
  return std::abs(face.height(place)) <= edge_width;
}

/// Whether `outward` of a corner (outward_of) points against a face's normal. A face that keeps two solids
/// apart at a corner of one has all edges of the corner on its outer side, and so the corner points against it.
inline bool points_against(const Vector3d& outward, const Vector3d& normal) {
  constexpr double least = 1e-9;
  return dot(outward, normal) < -least;
}

/// Of the faces on whose border `place` lies, the one against which `outward` points most; none where it
/// points against none of them, as a zero `outward` does. O(faces there).
std::optional<Face> touched_face(const Surface& surface, const Vector3d& place,
                                 const Vector3d& outward);

/// The share of a contact that a corner at `place` takes, `depth` [m] deep along the unit `normal`: a half
/// where a corner of the surface lies over or under it, which touches there itself; else 1. O(corners there).
double share_with_corner(const Surface& surface, const Vector3d& place, const Vector3d& normal,
                         double depth);

}  // namespace hookpoint::contact
