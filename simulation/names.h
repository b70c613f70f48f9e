// Names of bodies as people read them.
#pragma once

#include <string>
#include <vector>

#include "simulation/experiment.h"

namespace hookpoint::simulation {

/// The trail of every body without the world's name, in the order of WorldState::bodies:
/// "block.base", "simplebot.leg1.link2".
std::vector<std::string> body_trails(const Experiment& experiment);

}  // namespace hookpoint::simulation
