// Orientations as a user writes them: a quaternion, or roll, pitch and yaw.
#pragma once

#include <algorithm>
#include <array>
#include <cmath>
#include <optional>
#include <span>

namespace hookpoint {

/// Rz(yaw) Ry(pitch) Rx(roll) as a quaternion w, x, y, z.
inline std::array<double, 4> quaternion_of_roll_pitch_yaw(std::span<const double, 3> angles) {
  const double cr = std::cos(angles[0] / 2.), sr = std::sin(angles[0] / 2.);
  const double cp = std::cos(angles[1] / 2.), sp = std::sin(angles[1] / 2.);
  const double cy = std::cos(angles[2] / 2.), sy = std::sin(angles[2] / 2.);
  return {cr * cp * cy + sr * sp * sy, sr * cp * cy - cr * sp * sy, cr * sp * cy + sr * cp * sy,
          cr * cp * sy - sr * sp * cy};
}

/// Unit quaternion w, x, y, z of four numbers of any length, or of three angles [rad]; nothing for
/// the zero quaternion. A unit quaternion stays as it is, bit for bit, so that what is printed
/// reads back the same.
inline std::optional<std::array<double, 4>> orientation_of(std::span<const double> numbers) {
  if (numbers.size() == 3) return quaternion_of_roll_pitch_yaw(numbers.first<3>());
  std::array<double, 4> unit{numbers[0], numbers[1], numbers[2], numbers[3]};
  double largest = 0.;
  for (const double x : unit) largest = std::max(largest, std::fabs(x));
  if (largest == 0.) return std::nullopt;
  double square = 0.;
  for (const double x : unit) square += (x / largest) * (x / largest);
  const double norm = largest * std::sqrt(square);
  if (std::fabs(norm - 1.) > 1e-14) {
    for (double& x : unit) x /= norm;
  }
  return unit;
}

}  // namespace hookpoint
