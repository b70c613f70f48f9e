// Step 1 of Fig. 3 of Reichler & Delcomyn 2000: kinematics from the base outwards.
#pragma once

#include "dts/state.h"
#include "dts/workspace.h"

namespace hookpoint::dts {

/// World pose and velocity of every body (`workspace.bodies`), and what the other passes need of
/// the state. Every other function that takes a workspace and no state means the state given here
/// last. O(links).
template <class Real>
void forward_kinematics(const Model<Real>& model, const State<Real>& state,
                        Workspace<Real>& workspace);

extern template void forward_kinematics(const Model<double>&, const State<double>&,
                                        Workspace<double>&);

}  // namespace hookpoint::dts
