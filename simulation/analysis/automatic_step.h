// `deltat = auto`: a step chosen from the largest stable one.
#pragma once

#include <string>

#include "simulation/experiment.h"

namespace hookpoint::simulation {

struct ChosenStep {
  double step = 0.;     ///< [s]; 0 where none can be chosen
  double bound = 0.;    ///< the largest stable step that it is chosen from [s]
  std::string problem;  ///< why none can be chosen
};

/// The largest of 1, 2 and 5 times a power of ten that is at most `safe_part` of the largest stable
/// step and divides the periods of all that has a rate, as far as one does. The experiment's own
/// deltat does not matter.
ChosenStep choose_step(const Experiment& experiment);

/// The bound is of the initial posture and its loads. Half of it bears a contact that has become
/// four times as stiff, and resolves the fastest vibration with some six steps instead of three.
inline constexpr double safe_part = 0.5;

}  // namespace hookpoint::simulation
