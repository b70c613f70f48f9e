// MuJoCo as a peer.
#pragma once

#include "reference/peer.h"

namespace hookpoint::reference {

/// MuJoCo, whose contacts are soft constraints of a convex problem (`engine = mujoco`).
extern const Peer mujoco_peer;

}  // namespace hookpoint::reference
