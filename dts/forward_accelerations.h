// Step 4 of Fig. 3 of Reichler & Delcomyn 2000: accelerations from the base outwards.
#pragma once

#include "dts/workspace.h"

namespace hookpoint::dts {

/// Sets joint_accelerations and hip_wrenches from `workspace.base_motion`. O(links).
template <class Real>
void forward_accelerations(const Model<Real>& model, Workspace<Real>& workspace);

extern template void forward_accelerations(const Model<double>&, Workspace<double>&);

}  // namespace hookpoint::dts
