// How easily a force moves a body of a robot, joints free: MuJoCo scales its contacts by it.
#pragma once

#include <cstddef>

#include "simulation/experiment/experiment.h"

namespace hookpoint::simulation {

/// tr(J M^-1 J^T)/3 for the Jacobian J of the body's centre of mass, at joint positions 0: the mean
/// over directions of its acceleration per newton [1/kg]. body_invweight0 of MuJoCo (manual,
/// Computation, Constraint model, diagonal approximation). 1/mass of a free body. `body` counts as
/// in robot_tree.h.
double inverse_weight(const Experiment& experiment, std::size_t robot, std::size_t body);

}  // namespace hookpoint::simulation
