// An experiment as an engine that is a program reads it (docs/engine_protocol.md, "experiment").
#pragma once

#include <string>

#include "simulation/experiment/experiment.h"

namespace hookpoint::reference {

/// O(experiment). Nothing in it is what the protocol has no word for (protocol_gaps, engine.h).
std::string experiment_json(const simulation::Experiment& experiment);

}  // namespace hookpoint::reference
