// The terrain as a peer wants it: an infinite plane, or triangles.
#pragma once

#include <variant>

#include "math/vector3.h"
#include "simulation/experiment.h"
#include "simulation/ground_mesh.h"

namespace hookpoint::reference {

/// Points x with normal . x = offset; the ground is below. An extent given to a Flat or Slope is
/// not an edge here, as it is none in our own terrain (a point beyond it sees the edge's tile,
/// which is this plane).
struct GroundPlane {
  Vector3d normal;     ///< unit, out of the ground
  double offset = 0.;  ///< [m]
};
using simulation::GroundMesh;
using Ground = std::variant<GroundPlane, GroundMesh>;

/// `lowered_by` [m]: a plane along its normal, a grid's vertices straight down, for balls about
/// points that are to meet the ground where the points do (touching_points.h).
Ground ground_of(const simulation::TerrainSpec& terrain, double lowered_by = 0.);

}  // namespace hookpoint::reference
