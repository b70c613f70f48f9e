// What bounds a cloud of points: its convex hull, and the corners of that, by which a mesh
// touches the ground.
#pragma once

#include <cstddef>
#include <span>
#include <vector>

#include "math/vector3.h"
#include "simulation/experiment/experiment.h"

namespace hookpoint::simulation {

/// The vertices of the convex hull of `points`, in their order (Barber, Dobkin & Huhdanpaa 1996,
/// The quickhull algorithm for convex hulls, ACM Trans. Math. Softw. 22, as Qhull has it). Points
/// that stand out by less than 1e-6 of the whole's size are none of it. Of points in a plane or
/// fewer than five, all of them. n log n in the points.
std::vector<Vector3d> hull_vertices(std::span<const Vector3d> points);

/// The convex hull of `points`, its vertices as hull_vertices() has them. Without faces where the
/// points lie in a plane, or so nearly that no solid is found.
Hull convex_hull(std::span<const Vector3d> points);

/// The unit normal of a face, outwards.
Vector3d face_normal(const Hull& hull, const std::vector<std::size_t>& face);

/// `most` of the points at most, in their order: those farthest out along the axes and the
/// diagonals of the cube, then again and again the one that is farthest from all that are taken.
/// O(most points).
std::vector<Vector3d> spread_points(std::span<const Vector3d> points, std::size_t most);

}  // namespace hookpoint::simulation
