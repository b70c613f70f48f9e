// One step of a robot under a force law. `step.cpp` is the place to begin reading the engine.
#pragma once

#include <string>

#include "integrators/stepper.h"
#include "simulation/dts_engine/stepped_system.h"
#include "simulation/engine_interface/engine.h"

namespace hookpoint::simulation {

/// Advances the robot by the experiment's deltat from `time` [s] under the present inputs. On
/// failure nothing has changed. Costs what the stepper does: an evaluation of forces and
/// accelerations a stage, O(links
/// + points) each. Allocates nothing.
StepStatus step(SteppedSystem& robot, integrators::Stepper& stepper, double time);

/// What to do where an implicit integrator would have too many unknowns, `bristles` of them those
/// of contacts.
std::string too_many_unknowns(std::size_t unknowns, std::size_t bristles);

}  // namespace hookpoint::simulation
