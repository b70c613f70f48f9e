// How deep a contact of a reference engine rests under a load, where all engines are alike.
#pragma once

#include "simulation/experiment/closed_form.h"
#include "simulation/experiment/experiment.h"

namespace hookpoint::reference {

/// Depth per newton of a contact at rest [m/N]: at `settings = matched` every peer has the
/// material's spring, 1/k. No closed form at another setting.
simulation::ClosedForm<double> matched_softness(const simulation::Experiment& experiment);

}  // namespace hookpoint::reference
