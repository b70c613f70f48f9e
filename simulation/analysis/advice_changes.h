// Which constant to change: advice in words.
#pragma once

#include <string>
#include <vector>

#include "simulation/analysis/advice.h"

namespace hookpoint::simulation {

/// One line a change, the most pressing first; empty when nothing needs to change.
std::vector<std::string> advise_changes(const Experiment& experiment, const Advice& advice);

}  // namespace hookpoint::simulation
