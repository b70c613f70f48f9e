// A law's constants chosen so that under the scene's load it is the same ground as hookpoint's: as
// deep, as stiff about that depth, and with the same rebound of what lands. Constants of laws have
// units of their own: the same number of normal_stiffness is another ground in each.
#pragma once

#include <string>
#include <vector>

#include "simulation/analysis/carried_load.h"

namespace hookpoint::simulation {

/// A constant of a material as it is and as it was chosen. SI.
struct MatchedConstant {
  std::string name, unit;
  double own = 0., chosen = 0.;
};

/// What one material became, and how near that comes to hookpoint with the material's own
/// constants.
struct MatchedMaterial {
  int material = 0;  ///< index among the experiment's
  std::string name;
  CarriedLoad under;                       ///< what it was matched under
  std::vector<MatchedConstant> constants;  ///< that were changed
  /// Under the load, over hookpoint's: 1 where matched. Of an impulse law 0: it has no depth.
  double depth = 1., stiffness = 1.;
  /// Of a landing the rebound over hookpoint's; where nothing comes down, the damping about rest
  /// over hookpoint's.
  double rebound = 1.;
};

/// One a material that the first mobile robot, or else the first one, stands or lands on. Of the
/// laws with hookpoint's linear normal spring nothing is changed; `nominal` is soft as hookpoint up
/// to its nominal depth; `hunt_crossley` becomes linear in depth; `exponential` has hookpoint's
/// tangent; any other law matches depth and rebound by its own predictions, `azad_featherstone` at
/// 1.5 times the stiffness; an impulse law matches the rebound alone (docs/studies.md). Throws
/// ExperimentError where there is nothing to match: a peer, no ground, no weight.
std::vector<MatchedMaterial> matched_to_hookpoint(const Experiment& experiment);

}  // namespace hookpoint::simulation
