// What bounds a cloud of points: its box, and its corners, by which a mesh touches the ground.
#pragma once

#include <cstddef>
#include <span>
#include <vector>

#include "math/vector3.h"

namespace hookpoint::simulation {

/// The corners of the points' bounding box. Of at least one point; linear.
struct Bounds {
  Vector3d low, high;
};
Bounds bounds_of(std::span<const Vector3d> points);

/// The vertices of the convex hull of `points`, in their order (Barber, Dobkin & Huhdanpaa 1996,
/// The quickhull algorithm for convex hulls, ACM Trans. Math. Softw. 22, as Qhull has it). Points
/// that stand out by less than 1e-6 of the whole's size are none of it. Of points in a plane or
/// fewer than five, all of them. n log n in the points.
std::vector<Vector3d> hull_vertices(std::span<const Vector3d> points);

/// `most` of the points at most, in their order: those farthest out along the axes and the
/// diagonals of the cube, then again and again the one that is farthest from all that are taken.
/// O(most points).
std::vector<Vector3d> spread_points(std::span<const Vector3d> points, std::size_t most);

}  // namespace hookpoint::simulation
