// The world under an impulse law: no forces and no integrator, but flight from impact to impact, of
// single rigid bodies and of robots with chains alike.
#pragma once

#include "simulation/engine.h"

namespace hookpoint::simulation {

std::unique_ptr<Engine> make_impulse_engine(const Experiment& experiment);

}  // namespace hookpoint::simulation
