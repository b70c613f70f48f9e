// What holds a robot's accelerations at 0: h of M v' + h = tau.
#pragma once

#include "dts/workspace.h"

namespace hookpoint::dts {

/// h, in the coordinates of mass_matrix.h: what velocities and gravity take, by inverse dynamics
/// at v' = 0 [N m, N]. No external force is in it: workspace.external is cleared. At the state that
/// forward_kinematics saw last; of one at rest, h is what gravity takes. O(links).
std::vector<double> bias_forces(const Model<double>& model, const Vector3d& gravity_W,
                                Workspace<double>& workspace);

}  // namespace hookpoint::dts
