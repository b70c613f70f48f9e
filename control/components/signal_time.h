// When a signal's moment has come, on a clock whose times are k dt in floating point.
#pragma once

#include "control/component.h"

namespace hookpoint::control {

/// Whether `moment` [s] is not after the tick. k dt may fall short of the decimal number meant (6 x
/// 0.1 and 0.6 differ), so a millionth of the period counts as reached; a schedule cannot tell
/// moments closer than a period apart anyway.
inline bool reached(const Tick& tick, double moment) {
  return tick.time + 1e-6 * tick.period >= moment;
}

}  // namespace hookpoint::control
