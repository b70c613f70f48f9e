// ODE as a peer: one library, two solvers, a row each.
#pragma once

#include "reference/peer.h"

namespace hookpoint::reference {

/// ODE with dWorldStep: one matrix of all constraints, Dantzig's method (`engine = ode`).
extern const Peer ode_peer;
/// ODE with dWorldQuickStep: successive over-relaxation (`engine = ode_quickstep`).
extern const Peer ode_quickstep_peer;

}  // namespace hookpoint::reference
