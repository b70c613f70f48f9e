// The largest stable step of a robot whose joints are under wired controllers: the eigenvalues of
// the exact map over one period of the controllers.
#pragma once

#include <span>
#include <string_view>

#include "simulation/analysis/joint_loops.h"
#include "simulation/analysis/linear_dynamics.h"

namespace hookpoint::simulation {

/// As `largest_stable_step` of vibration.h, with `loops` closed: controllers see the state at the
/// beginning of a step and hold their torque, all at the period of the first [s]. A step that does
/// not divide the period counts as the next smaller one that does, a delay that is no whole number
/// of periods as the next larger one that is. 0 where the loops are unstable at any step; infinity
/// for an adaptive integrator. About 40 eigenvalue problems of size 2 n + what the controllers
/// remember.
double largest_stable_step(std::string_view integrator, const Vibration& vibration,
                           std::span<const JointLoop> loops);

}  // namespace hookpoint::simulation
