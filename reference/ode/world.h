// The experiment as an ODE world.
#pragma once

#include <memory>
#include <string_view>

#include "reference/peer_engine.h"
#include "reference/settings.h"

namespace hookpoint::reference {

std::unique_ptr<PeerWorld> make_ode_world(const simulation::Experiment& experiment,
                                          Settings settings, OdeSolver solver,
                                          std::string_view engine);

}  // namespace hookpoint::reference
