// DART as a peer.
#pragma once

#include "reference/peer.h"

namespace hookpoint::reference {

/// DART's World with its boxed LCP (Dantzig's method, Gauss-Seidel where that fails) and FCL
/// (`engine = dart`).
extern const Peer dart_peer;

}  // namespace hookpoint::reference
