// How a Simbody contact at rest creeps, in closed form.
#pragma once

#include "simulation/engine_interface/engine.h"
#include "simulation/experiment/closed_form.h"
#include "simulation/experiment/experiment.h"

namespace hookpoint::reference {

/// x with 10 x^3 - 15 x^4 + 6 x^5 = `share`, which is within 0 and 1: the speed of a contact that sticks
/// over the transition velocity, where friction is that share of mu_s N.
double simbody_stiction_speed(double share);

/// Simbody's friction is a function of speed. At `matched` c_t v, at each point up to mu N there;
/// else N mu_s (10 x^3 - 15 x^4 + 6 x^5), x = v/v_t, of its stiction (stribeck() in
/// CompliantContactSubsystem.cpp).
simulation::ClosedForm<simulation::CreepVelocity> simbody_creep(
    const simulation::Experiment& experiment);

}  // namespace hookpoint::reference
