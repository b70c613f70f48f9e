// One step of a robot under a force law. `step.cpp` is the place to begin reading the engine.
#pragma once

#include "integrators/stepper.h"
#include "simulation/engine/robot_system.h"

namespace hookpoint::simulation {

/// Kinematics of every body at the robot's present state and all forces on it, in its workspace.
/// O(links + points).
void evaluate_forces(ArticulatedRobot& robot, ContactSet& contacts, Evaluation evaluation);

/// Advances the robot by `dt` [s] from `time` [s] under the present inputs. On failure nothing has
/// changed. Costs what the stepper does: an evaluation of forces and accelerations a stage, O(links
/// + points) each. Allocates nothing.
StepStatus step(RobotSystem& robot, integrators::Stepper& stepper, double time, double dt);

}  // namespace hookpoint::simulation
