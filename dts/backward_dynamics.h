// Step 2 of Fig. 3 of Reichler & Delcomyn 2000: inertias and forces from the chains' ends to the
// hips.
#pragma once

#include <span>

#include "dts/workspace.h"

namespace hookpoint::dts {

/// Sets each chain's hip relation f = IA a + pA (`workspace.hips`) and each link's U, D, u, from
/// the kinematics, the external wrenches and the joint torques [N m or N, one a link]. O(links).
template <class Real>
void backward_dynamics(const Model<Real>& model,
                       std::span<const std::type_identity_t<Real>> joint_torques,
                       Workspace<Real>& workspace);

extern template void backward_dynamics(const Model<double>&, std::span<const double>,
                                       Workspace<double>&);

}  // namespace hookpoint::dts
