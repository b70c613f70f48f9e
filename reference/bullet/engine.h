// Bullet as a peer.
#pragma once

#include "reference/peer.h"

namespace hookpoint::reference {

/// Bullet's btDiscreteDynamicsWorld with its sequential impulse solver; robots with chains are in
/// its btMultiBodyDynamicsWorld (`engine = bullet`).
extern const Peer bullet_peer;

}  // namespace hookpoint::reference
