// The experiment as a Simbody world.
#pragma once

#include <memory>

#include "reference/peer_engine.h"

namespace hookpoint::reference {

std::unique_ptr<PeerWorld> make_simbody_world(const simulation::Experiment& experiment,
                                              Settings settings);

}  // namespace hookpoint::reference
