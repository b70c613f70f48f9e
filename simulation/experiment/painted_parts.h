// The ground's plan cut into few parts of one material each, along the tiles that its patches paint.
#pragma once

#include <vector>

#include "contact/terrain/terrain.h"

namespace hookpoint::simulation {

/// Cells of two tiles along x or y, by their whole numbers: [first, last), the last one cut at `end`.
struct CellRow {
  double origin = 0., spacing = 1., first = 0., end = 0., last = 0.;

  double at(double cell) const { return origin + (cell < end ? cell : end) * spacing; }
};

/// Of a ground of that extent [m] from `origin`.
CellRow cells_of_extent(double origin, double spacing, double size);
/// Of a ground without an edge, those that hold `least` to `most` [m].
CellRow cells_between(double spacing, double least, double most);

/// Convex, counter-clockwise from above; z is 0.
struct PaintedPart {
  int material = 0;
  std::vector<Vector3d> corners;
};

/// Parts that cover all cells. Their number grows with the patches and the cells along patches'
/// edges.
std::vector<PaintedPart> painted_parts(const contact::Terrain& ground, const CellRow& columns,
                                       const CellRow& rows);

}  // namespace hookpoint::simulation
