// Motors and gears that turn with their joints.
#pragma once

#include <span>

#include "simulation/engine_interface/engine.h"

namespace hookpoint::simulation {

/// sum I_r q'^2 / 2 [J] of a robot whose joints move as `joints`, one a link. O(links).
double rotor_energy(const RobotSpec& robot, std::span<const JointState> joints);

}  // namespace hookpoint::simulation
