// Simbody as a peer.
#pragma once

#include "reference/peer.h"

namespace hookpoint::reference {

/// Simbody with its compliant contact and an integrator of steps of its own (`engine = simbody`).
extern const Peer simbody_peer;

}  // namespace hookpoint::reference
