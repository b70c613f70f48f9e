// Numbers that are close to normal, the same with every standard library.
#pragma once

#include <random>

namespace hookpoint::testing {

/// Of mean 0 and variance 1: the sum of twelve uniform numbers less 6 (Irwin & Hall).
inline double normal_number(std::mt19937_64& random) {
  double sum = -6.;
  for (int i = 0; i < 12; ++i) sum += static_cast<double>(random() >> 11) * 0x1p-53;
  return sum;
}

}  // namespace hookpoint::testing
