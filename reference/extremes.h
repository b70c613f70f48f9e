// Values so large that a library given them would end the process, by its own checks, or never
// return.
#pragma once

#include <algorithm>
#include <cmath>

#include "math/vector3.h"

namespace hookpoint::reference {

/// Whether the fourth power of every component is still a number; not of NaN and infinity.
inline bool moderate(const Vector3d& a) {
  constexpr double extreme = 1e50;
  return std::max({std::abs(a.x), std::abs(a.y), std::abs(a.z)}) < extreme &&
         !std::isnan(a.x + a.y + a.z);
}

}  // namespace hookpoint::reference
