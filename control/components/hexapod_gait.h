// The gaits of six legs.
#pragma once

#include "control/components/legged_gait.h"

namespace hookpoint::control {

constexpr std::size_t leg_count = 6;

/// Legs are numbered as in configs/robots/hexapod_legs.hook: 0 to 2 the right ones from the rear, 3
/// to 5 the left ones. Legs 0, 2, 4 are one tripod (right hind and front, left middle), 1, 3, 5 the
/// other.
constexpr bool in_first_tripod(std::size_t leg) { return leg % 2 == 0; }

}  // namespace hookpoint::control
