// Stairs as they are drawn: level treads and vertical risers, as far as their ground reaches.
#pragma once

#include <vector>

#include "simulation/experiment/experiment.h"

namespace hookpoint::simulation {

/// Whether the ground is stairs whose risers bodies meet upright: under `touch = points`, under an
/// impulse law and in other engines they meet the ramps of its grid.
bool has_risers(const Experiment& experiment);

/// A flat part of one material.
struct StairsFace {
  int material = 0;
  std::vector<Vector3d> corners;  ///< convex, counter-clockwise from outside; at most six [m]
};

/// Of a ground that is stairs. A tread or a riser is one face but where patches cut it.
std::vector<StairsFace> stairs_faces(const contact::Terrain& ground);

}  // namespace hookpoint::simulation
