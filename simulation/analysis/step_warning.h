// Warning of a step that is above the largest stable one: one wording for the command, the window,
// Python and studies.
#pragma once

#include <optional>
#include <string>

#include "simulation/analysis/stability.h"
#include "simulation/experiment/experiment.h"

namespace hookpoint::simulation {

/// "deltat 0.001 s is above the largest stable step ...", with what to do about it; none where the
/// step is stable. Costs a stability_bound, except where `deltat = auto` chose the step from one.
std::optional<std::string> step_warning(const Experiment& experiment);
/// The same where the bound is known.
std::optional<std::string> step_warning(const Experiment& experiment, const StabilityBound& bound);

}  // namespace hookpoint::simulation
