// The largest step with which an integrator lets no motion of a robot grow.
#pragma once

#include <limits>
#include <span>

#include "integrators/stepper.h"
#include "simulation/analysis/joint_loops.h"
#include "simulation/analysis/linear_dynamics.h"

namespace hookpoint::simulation {

/// The largest step with which no motion of the linear dynamics grows, with `loops` closed (the
/// controllers of period_map.h) [s]; infinity without forces and for an adaptive integrator, 0
/// where something grows at any step. Motions that nothing resists and those that fall over by
/// themselves do not count. A step that does not divide the controllers' period counts as the next
/// smaller one that does. Without loops, of a bound that is not below `least` only that is said: it
/// may be any number that is not below.
///
/// By what the integrator says of its stability (integrators/stability_bound.h), O(n^3); with
/// loops, or where it says nothing, from about 40 eigenvalue problems of size 2 n + what the
/// controllers remember.
double largest_stable_step(const integrators::StepperDescription& stepper,
                           const LinearDynamics& dynamics, std::span<const JointLoop> loops = {},
                           double least = std::numeric_limits<double>::infinity());

}  // namespace hookpoint::simulation
