// What of a MuJoCo contact at rest has a closed form: how it creeps, and how deep it stands.
#pragma once

#include "simulation/engine_interface/engine.h"
#include "simulation/experiment/closed_form.h"
#include "simulation/experiment/experiment.h"

namespace hookpoint::reference {

/// Velocity of a single body that sticks to a plane. At rest the rows of a contact say
/// B v + K d r + R f = 0 with r = 0 in a friction row, so it creeps: an elliptic contact at R
/// f_t/B. A pyramid's rows, along normal +- mu tangent, mix both, and one that would pull is left
/// out. Nothing where that has no closed form: other robots and grounds, and where a contact slips
/// or lacks a row that another one has (the friction's moment takes load off the uphill contacts).
/// The impedance d is taken at the mean depth. Nothing with no-slip iterations.
simulation::ClosedForm<simulation::CreepVelocity> mujoco_creep(
    const simulation::Experiment& experiment);

/// Depth per newton [m/N]: at `matched` the material's spring, while the impedance is not cut off
/// (mujoco_row). Nothing otherwise.
simulation::ClosedForm<double> mujoco_softness(const simulation::Experiment& experiment);

}  // namespace hookpoint::reference
