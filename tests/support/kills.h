// How often a test kills what it tests.
#pragma once

#include <cstdlib>

namespace hookpoint::testing {

/// Ten times, or as often as .ci/full wants.
inline int wanted_kills() {
  const char* wanted = std::getenv("HOOKPOINT_KILLS");
  return wanted == nullptr ? 10 : std::atoi(wanted);
}

}  // namespace hookpoint::testing
