// What the page shows of a robot whose file has no windows (page/overview.ts), so that it is plotted
// from the beginning on.
#pragma once

#include <string>
#include <vector>

#include "simulation/experiment/experiment.h"

namespace hookpoint::view {

/// Trails of the first robot that moves, or of the first.
std::vector<std::string> overview_of(const simulation::Experiment& experiment);

}  // namespace hookpoint::view
