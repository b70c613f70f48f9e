// What of an ODE contact at rest has a closed form: how it creeps, and how deep it stands.
#pragma once

#include "simulation/engine_interface/engine.h"
#include "simulation/experiment/closed_form.h"
#include "simulation/experiment/experiment.h"

namespace hookpoint::reference {

/// dWorldStep's friction rows yield by CFM times their force, and within the surface layer, where
/// nothing pushes out what the normal rows let in, the body tilts. Nothing where a row is at its
/// limit, and where the fall of the first step is most of the layer.
simulation::ClosedForm<simulation::CreepVelocity> ode_creep(
    const simulation::Experiment& experiment);

/// Depth per newton [m/N] with dWorldStep: at `matched` the material's spring; at `default`, of
/// J v = ERP d/dt - CFM f, the rest, d = CFM dt f/ERP. Nothing with a surface layer.
simulation::ClosedForm<double> ode_softness(const simulation::Experiment& experiment);

}  // namespace hookpoint::reference
