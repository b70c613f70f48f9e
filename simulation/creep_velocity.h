// How a body creeps on a plane that should hold it: what a peer's closed form says, and a study
// sets beside the measurement.
#pragma once

namespace hookpoint::simulation {

/// Steady velocity of a body's origin in the ground's plane.
struct CreepVelocity {
  double downhill = 0.;  ///< along the fall [m/s]
  double sideways = 0.;  ///< along normal x downhill [m/s]
};

}  // namespace hookpoint::simulation
