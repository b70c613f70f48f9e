// Random numbers that are the same with every library.
#pragma once

#include <random>

namespace hookpoint::studies {

/// 0 <= x < 1 from the 53 upper bits of the next number: the standard leaves its distributions to
/// the library, its generators not.
inline double random_place(std::mt19937_64& random) {
  return static_cast<double>(random() >> 11) * 0x1p-53;
}

}  // namespace hookpoint::studies
