// Corners of what touches: of points that move as one rigid body and have one normal, the normal
// impulses of those inside the convex hull of the others are sums of the others', so that they add
// nothing to an impact. 4 points or 100 on the face of a box then bounce alike.
#pragma once

#include <cstddef>
#include <span>

namespace hookpoint::contact {

struct PlanePoint {
  double x = 0., y = 0.;   ///< across the normal [m]
  std::size_t number = 0;  ///< the caller's
};

/// Moves the corners of the convex hull of `points` to the front, in an order that is theirs alone;
/// how many there are. Points within 1e-9 of the extent of an edge are no corners. Allocates nothing.
/// `corners` as long as `points` + 1. O(n log n) (Andrew 1979).
std::size_t keep_extreme(std::span<PlanePoint> points, std::span<PlanePoint> corners);

}  // namespace hookpoint::contact
