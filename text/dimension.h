// Physical dimensions: exponents of mass, length, time and angle. Angle is kept apart so that `mass
// = 3 deg` is an error, though a radian is a pure number: a value without angle (5 N.m) fits a
// field per angle (N.m/rad).
#pragma once

#include <string>

namespace hookpoint::text {

struct Dimension {
  int mass = 0, length = 0, time = 0, angle = 0;

  bool operator==(const Dimension&) const = default;
  bool dimensionless() const { return *this == Dimension{}; }
};

}  // namespace hookpoint::text
