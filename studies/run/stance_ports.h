// Where the gait of a run tells which legs are to stand.
#pragma once

#include <vector>

#include "simulation/run/world.h"
#include "studies/measure/metric.h"

namespace hookpoint::studies {

/// One a chain of the measured robot: the values of the first component, in file order, that has an
/// output `stance` for each. Empty where none has. They live as long as the world. O(ports).
std::vector<const double*> stance_ports(const RunContext& context, simulation::World& world);

}  // namespace hookpoint::studies
