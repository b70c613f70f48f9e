// The part of a Push that acts in a step.
#pragma once

#include <cstdint>

#include "simulation/experiment/experiment.h"

namespace hookpoint::simulation {

/// From 0 outside the window to 1 inside, held over the step that begins at `step` dt. Without an
/// edge the steps from ceil(from / dt) up to, not including, ceil(to / dt), exactly; with one, half
/// a cosine over `edge` at both ends, taken in the middle of the step.
double envelope(const ForceWindow& window, std::int64_t step, double deltat);

}  // namespace hookpoint::simulation
