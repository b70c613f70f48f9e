// Which points of a body can lie on a plane at once: the faces of their convex hull.
#pragma once

#include <cstddef>
#include <span>
#include <vector>

#include "math/vector3.h"

namespace hookpoint::simulation {

struct HullFace {
  Vector3d normal;                  ///< unit, outwards; 0 for points on a line, which has no face
  std::vector<std::size_t> points;  ///< all that lie within the tolerance of its plane
};

/// The faces of the convex hull of `points`, by gift wrapping; coplanar points make one face. Of
/// points in a plane its two sides, of points on a line or of a single one all of them, once.
/// `tolerance` [m]: how far from its plane a point belongs to a face. O(faces (faces + points)); of
/// many points not all faces are looked for: 2e7/points, and 50 at least.
std::vector<HullFace> hull_faces(std::span<const Vector3d> points, double tolerance);

}  // namespace hookpoint::simulation
