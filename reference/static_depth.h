// How far a peer's contact gives way under a load that rests on it, where all peers are alike.
#pragma once

#include <optional>

#include "simulation/experiment.h"

namespace hookpoint::reference {

/// Depth per newton of a contact at rest [m/N]: at `settings = matched` every peer has the
/// material's spring, 1/k. Nothing at another setting.
std::optional<double> matched_softness(const simulation::Experiment& experiment);

}  // namespace hookpoint::reference
