// The experiment as a DART world.
#pragma once

#include <memory>

#include "reference/peer_engine.h"

namespace hookpoint::reference {

/// Worlds of any settings step in any threads at once; two whose constants differ take turns, since
/// the library keeps a contact's constants once a process.
std::unique_ptr<PeerWorld> make_dart_world(const simulation::Experiment& experiment,
                                           Settings settings);

}  // namespace hookpoint::reference
