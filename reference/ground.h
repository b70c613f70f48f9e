// The terrain as a peer wants it: an infinite plane, triangles, or the boxes of stairs.
#pragma once

#include <variant>

#include "math/vector3.h"
#include "simulation/experiment/experiment.h"
#include "simulation/experiment/ground_mesh.h"

namespace hookpoint::reference {

/// Points x with normal . x = offset; the ground is below. An extent given to a Flat or Slope is
/// not an edge here, as it is none in our own terrain (a point beyond it sees the edge's tile,
/// which is this plane).
struct GroundPlane {
  Vector3d normal;     ///< unit, out of the ground
  double offset = 0.;  ///< [m]
};
using simulation::GroundMesh;
/// Stairs: all of them are among solids_of (solids.h).
struct GroundStairs {};
using Ground = std::variant<GroundPlane, GroundMesh, GroundStairs>;

Ground ground_of(const simulation::TerrainSpec& terrain);

/// Whether the ground moves as a whole, not its material alone.
bool ground_frame_moves(const simulation::Experiment& experiment);

/// Of a velocity of the ground's material the part along a plane; on a grid all of it.
Vector3d along_ground(const simulation::TerrainSpec& terrain, const Vector3d& velocity);

}  // namespace hookpoint::reference
