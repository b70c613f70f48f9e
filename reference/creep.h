// Closed forms of the creep of a body at rest on a plane, for peers whose friction yields.
#pragma once

#include <optional>

#include "simulation/experiment.h"

namespace hookpoint::reference {

/// Tangential speed per newton of a sticking contact of DART [m/(N s)]: at `matched` the friction
/// rows' mixing; else DART's relative one, CFM (J M^-1 J^T)_tt dt of impulses, with the row along
/// the fall. Nothing where the experiment is not one body at rest on a slope, where its touching
/// points differ in that row, or where it touches by meshes.
std::optional<double> dart_friction_mixing(const simulation::Experiment& experiment);

/// The same of Simbody: at `matched` 1/c_t; else v/f_t with the speed v at which the friction
/// coefficient mu_s (10 x^3 - 15 x^4 + 6 x^5), x = v/v_t, of Simbody's stiction is f_t/N
/// (stribeck() in CompliantContactSubsystem.cpp). Nothing where the body does not rest.
std::optional<double> simbody_friction_mixing(const simulation::Experiment& experiment);

}  // namespace hookpoint::reference
