// A run whose step is longer than its contacts bear is told of before it starts.
#pragma once

#include <optional>
#include <string>

#include "simulation/experiment.h"

namespace hookpoint::studies {

/// "deltat 0.01 s is above the largest stable step ...", where it is
/// (simulation/analysis/stability.h).
std::optional<std::string> step_warning(const simulation::Experiment& experiment);

}  // namespace hookpoint::studies
