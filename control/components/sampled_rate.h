// The rate of a controlled value, as controllers of one value take it.
#pragma once

#include "control/component.h"

namespace hookpoint::control {

/// d(current)/dt: `rate_in` where it is driven, else from the sample before; 0 on the first update
/// where it would take two samples.
inline double sampled_rate(const Input& rate_in, double current, double previous,
                           const Tick& tick) {
  if (rate_in.driven()) return rate_in;
  return tick.count == 0 ? 0. : (current - previous) / tick.period;
}

}  // namespace hookpoint::control
