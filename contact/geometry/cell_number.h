// Which of a row of equal cells holds a place.
#pragma once

#include <algorithm>
#include <cmath>
#include <cstdint>

namespace hookpoint::contact {

/// The cell of `count` that holds the place `at`, which is counted in cells from the row's beginning.
/// Beyond its ends the first and the last; the first for not-a-number, as a pose has that diverges.
inline std::int64_t cell_number(double at, std::int64_t count) {
  if (!(at > 0.)) return 0;
  return static_cast<std::int64_t>(std::min(std::floor(at), static_cast<double>(count - 1)));
}

}  // namespace hookpoint::contact
