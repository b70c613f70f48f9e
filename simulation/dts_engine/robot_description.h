// A robot of the experiment as the recursions read it.
#pragma once

#include "dts/model.h"
#include "dts/state.h"
#include "simulation/experiment/experiment.h"

namespace hookpoint::simulation {

/// The part of a RobotSpec that the recursions read.
dts::RobotDescription describe_robot(const RobotSpec& robot);

/// The robot's initial state. Joint positions add to theta (revolute) or d (prismatic).
dts::State<double> initial_state(const RobotSpec& robot);

}  // namespace hookpoint::simulation
