// How a DART contact at rest creeps, in closed form.
#pragma once

#include "simulation/engine_interface/engine.h"
#include "simulation/experiment/closed_form.h"
#include "simulation/experiment/experiment.h"

namespace hookpoint::reference {

/// At `matched` DART's friction rows yield by CFM times their force, else by
/// CFM (J M^-1 J^T)_ii dt, as impulses do. Nothing for meshes, whose contacts are those of
/// triangles.
simulation::ClosedForm<simulation::CreepVelocity> dart_creep(
    const simulation::Experiment& experiment);

}  // namespace hookpoint::reference
