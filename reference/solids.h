// What stands in the way of a robot as a shape of its own: the steps of stairs, and obstacles.
#pragma once

#include <cstddef>
#include <optional>
#include <vector>

#include "simulation/experiment/experiment.h"
#include "simulation/experiment/kinematics.h"

namespace hookpoint::reference {

struct Solid {
  simulation::ShapeGeometry geometry;
  simulation::Pose pose;                ///< X_WS at time 0
  int material = 0;                     ///< index into Experiment::materials
  std::optional<std::size_t> obstacle;  ///< index into Experiment::obstacles; none: of the ground
};

/// Stairs are a box under each tread, which reaches down to a common bottom and sideways, and over the
/// first and the last riser, for a kilometre; then obstacles in order.
std::vector<Solid> solids_of(const simulation::Experiment& experiment);

}  // namespace hookpoint::reference
