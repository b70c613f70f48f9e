// An experiment as an engine that is a program reads it (docs/engine_protocol.md, "experiment").
#pragma once

#include <string>

#include "simulation/experiment/experiment.h"

namespace hookpoint::reference {

/// The `experiment` message as JSON text, SI units. `experiment` uses no feature of protocol_gaps
/// (pool.cpp). Linear in its size.
std::string experiment_json(const simulation::Experiment& experiment);

}  // namespace hookpoint::reference
