// Names of bodies as users read them.
#pragma once

#include <string>
#include <vector>

#include "simulation/experiment/experiment.h"

namespace hookpoint::simulation {

/// The trails of a robot's bodies below it, in the order of robot_tree.h: "base", "leg1.link2".
std::vector<std::string> body_names(const RobotSpec& robot);

/// The trail of every body without the world's name, in the order of WorldState::bodies:
/// "block.base", "simplebot.leg1.link2".
std::vector<std::string> body_trails(const Experiment& experiment);

}  // namespace hookpoint::simulation
