// The experiment as an ODE world.
#pragma once

#include <memory>

#include "reference/ode/settings.h"
#include "reference/peer_engine.h"

namespace hookpoint::reference {

/// Worlds of dWorldStep may step in different threads at once and give the same bytes as one after
/// the other. Those of dWorldQuickStep take turns: the library draws its row order from one random
/// stream of the process.
std::unique_ptr<PeerWorld> make_ode_world(const simulation::Experiment& experiment,
                                          Settings settings, OdeSolver solver);

}  // namespace hookpoint::reference
