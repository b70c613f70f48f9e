// Our engine: the decoupled tree-structure recursion under a force law and an integrator, or, for
// the event-driven laws, free flight between impulses.
#pragma once

#include "simulation/engine_interface/engine.h"

namespace hookpoint::simulation {

/// Throws ExperimentError when the experiment cannot run: an unknown law or integrator.
std::unique_ptr<Engine> make_dts(const Experiment& experiment);

EngineDescription describe_dts();

}  // namespace hookpoint::simulation
