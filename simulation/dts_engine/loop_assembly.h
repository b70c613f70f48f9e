// A robot's loops at the start: joint angles that close them and rates that keep them closed, near those
// that a file gives.
#pragma once

#include "simulation/experiment/experiment.h"

namespace hookpoint::simulation {

struct LoopAssembly {
  double gap_before = 0.;  ///< greatest between the points of a loop at the angles given [m]
  double gap_after = 0.;   ///< likewise, at those that were found [m]
  double farthest = 0.;    ///< that a joint was moved [rad or m]
  std::size_t rows = 0;    ///< conditions that the loops put
  std::size_t rank = 0;    ///< of them that do not follow from others
};

/// Moves the joints of robot `index` until its exact loops are closed, by Newton's method with the base
/// held, and changes their rates to those nearest in kinetic energy that keep them closed; sets the second axis of hinges, which is what the first is then in body b. O(rounds (links +
/// conditions^3)).
LoopAssembly assemble_loops(Experiment& experiment, std::size_t index);

}  // namespace hookpoint::simulation
