// First-order dynamics whose input is held between updates, solved exactly: no step is too long for
// them.
#pragma once

#include <cmath>

namespace hookpoint::control {

/// The value after `period` [s] of time_constant dx/dt = target - x from `value`: x + (1 -
/// exp(-period/time_constant)) (target - x). A time constant of 0 [s] reaches the target.
inline double relaxed(double value, double target, double period, double time_constant) {
  return value - std::expm1(-period / time_constant) * (target - value);
}

}  // namespace hookpoint::control
