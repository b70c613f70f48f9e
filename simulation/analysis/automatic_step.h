// `deltat = auto`, the default: a step chosen from the largest stable one.
#pragma once

#include "simulation/experiment/experiment.h"

namespace hookpoint::simulation {

struct ChosenStep {
  double step = 0.;  ///< [s]
  /// The largest stable step that it is chosen from [s]; infinity where there is none, 0 where no
  /// step is stable.
  double bound = 0.;
};

/// The largest of 1, 2 and 5 times a power of ten that is at most `largest_automatic_step` and
/// `safe_part` of the largest stable step, in which no body turns by more than `largest_turn` as it
/// starts, and that divides the periods of all that has a rate where one of the next six does. Under
/// another engine the bound is that of the same experiment under engine dts, so that all engines take the same step. Where there is no bound (an impulse
/// law, an adaptive integrator, nothing that springs back) and where no step is stable,
/// `largest_automatic_step` alone is the limit. The experiment's own deltat does not matter. Costs
/// a stability_bound.
ChosenStep choose_step(const Experiment& experiment);

/// Resolves free flight, a swinging leg and the corners of an impact that a bound says nothing
/// about; every file without a step was integrated with it before there was a bound [s].
inline constexpr double largest_automatic_step = 1e-3;

/// The bound is of the initial posture and its loads. Half of it bears a contact that has become
/// four times as stiff, and resolves the fastest vibration with some six steps instead of three.
inline constexpr double safe_part = 0.5;

/// Gyroscopic forces of a step in which a body turns by 2 rad cannot be found; with half a radian
/// they are found in 13 iterations (integrators/semi_implicit_euler.h), and wheels get faster [rad].
inline constexpr double largest_turn = 0.5;

}  // namespace hookpoint::simulation
