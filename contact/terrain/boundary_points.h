// Boundary points: where a shape may touch the ground (Reichler & Delcomyn 2000, 3.3). More points
// are more accurate and slower; `density` is the language's `boundary_points`, 0 the shape's
// default. Points in the shape's frame [m].
//
// Sampled points make a polyhedron of a round shape. A sphere of density n touches flat ground
// exactly only at its points, up to r (1 - cos(pi/(2 n))) = 0.076 r (n = 4) too low along a
// meridian; it rolls from point to point, with hooks that are born and die, and rests on a facet on
// slopes below about 90/n degrees. A truth about rolling needs a dense sphere or a law's own
// sphere.
#pragma once

#include <vector>

#include "math/vector3.h"

namespace hookpoint::contact {

/// Box with edge lengths `dimensions`, centred. Each edge in `density` parts: the surface points of
/// that lattice, (n + 1)^3 - (n - 1)^3 of them. Default 1: the 8 corners, which is exact on flat
/// ground.
std::vector<Vector3d> box_points(const Vector3d& dimensions, int density);

/// Sphere of `radius`, centred: two poles on z and `density` - 1 circles of latitude of 2 `density`
/// points each. Default 4: 26 points. At least 2.
std::vector<Vector3d> sphere_points(double radius, int density);

/// Cylinder along z, centred: `density` points on the rim of each end, the first at +x. Default 8;
/// at least 3. A straight side needs no points of its own on flat ground. A disc, of length 0, has
/// one rim.
std::vector<Vector3d> cylinder_points(double radius, double length, int density);

/// Capsule along z, centred: the two halves of sphere_points(), each with its pole and its rim; of
/// an odd density the rims are the circles next to the equator. At least 2.
std::vector<Vector3d> capsule_points(double radius, double length, int density);

/// Truncated cone along +x, proximal face at the origin: `density` points on each rim, the first at
/// +z, a single point for a rim of radius 0. Default 8; at least 3.
std::vector<Vector3d> legcone_points(double length, double proximal_radius, double distal_radius,
                                     int density);

}  // namespace hookpoint::contact
