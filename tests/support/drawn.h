// Numbers drawn from a generator of 64 bits: the same on every machine, which the distributions of
// the standard library are not.
#pragma once

namespace hookpoint::test_support {

/// Of [0, 1).
template <class Generator>
double drawn_part(Generator& random) {
  return static_cast<double>(random() >> 11) * 0x1p-53;
}

/// Of [low, high).
template <class Generator>
double drawn(Generator& random, double low, double high) {
  return low + (high - low) * drawn_part(random);
}

}  // namespace hookpoint::test_support
