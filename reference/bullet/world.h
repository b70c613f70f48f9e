// The experiment as a Bullet world.
#pragma once

#include <memory>

#include "reference/peer_engine.h"

namespace hookpoint::reference {

std::unique_ptr<PeerWorld> make_bullet_world(const simulation::Experiment& experiment,
                                             Settings settings);

}  // namespace hookpoint::reference
