// The world under an impulse law: no forces and no integrator, but flight from impact to impact.
// Single rigid bodies.
#pragma once

#include "simulation/engine.h"

namespace hookpoint::simulation {

/// Throws ExperimentError for a robot with chains.
std::unique_ptr<Engine> make_impulse_engine(const Experiment& experiment);

}  // namespace hookpoint::simulation
