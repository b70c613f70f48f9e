// Shapes that MuJoCo has no type of, as the vertices whose hull its compiler takes.
#pragma once

#include <vector>

#include "simulation/experiment/experiment.h"

namespace hookpoint::reference {

/// In the shape's frame [m]: of a Hull its own, of a Legcone 32 around each end, of others none.
std::vector<Vector3d> mujoco_vertices(const simulation::ShapeGeometry& geometry);

}  // namespace hookpoint::reference
