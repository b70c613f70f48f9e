// Closed forms of the creep of a body at rest on a plane, for peers whose friction yields: the
// velocity of its origin. Each says nothing where the experiment is not one body whose
// touching points are known (resting_body.h), and where the body turns, so that its speed changes.
#pragma once

#include <optional>

#include "simulation/creep_velocity.h"
#include "simulation/experiment.h"

namespace hookpoint::reference {

/// ODE's friction rows yield by CFM times their force, and within the surface layer, where nothing
/// pushes out what the normal rows let in, the body tilts. Nothing where a row is at its limit, and
/// where the fall of the first step is most of the layer.
std::optional<simulation::CreepVelocity> ode_creep(const simulation::Experiment& experiment);

/// Those of DART at `matched` yield likewise, else by CFM (J M^-1 J^T)_ii dt, as impulses do.
/// Nothing for meshes, whose contacts are those of triangles.
std::optional<simulation::CreepVelocity> dart_creep(const simulation::Experiment& experiment);

/// Simbody's friction is a function of speed. At `matched` c_t v, at each point up to mu N there;
/// else N mu_s (10 x^3 - 15 x^4 + 6 x^5), x = v/v_t, of its stiction (stribeck() in
/// CompliantContactSubsystem.cpp).
std::optional<simulation::CreepVelocity> simbody_creep(const simulation::Experiment& experiment);

}  // namespace hookpoint::reference
