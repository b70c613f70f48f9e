// Random numbers that are the same with every library.
#pragma once

#include <cstddef>
#include <random>

namespace hookpoint::studies {

/// 0 <= x < 1 from the 53 upper bits of the next number: the standard leaves its distributions to
/// the library, its generators not.
inline double random_point(std::mt19937_64& random) {
  return static_cast<double>(random() >> 11) * 0x1p-53;
}

/// One of 0 to `count` - 1.
inline std::size_t random_index(std::mt19937_64& random, std::size_t count) {
  return static_cast<std::size_t>(random_point(random) * static_cast<double>(count));
}

}  // namespace hookpoint::studies
