// The experiment as a Bullet world.
#pragma once

#include <memory>

#include "reference/peer_engine.h"
#include "reference/settings.h"

namespace hookpoint::reference {

std::unique_ptr<PeerWorld> make_bullet_world(const simulation::Experiment& experiment,
                                             const BulletSettings& settings);

}  // namespace hookpoint::reference
