// A function of time through given points, with its derivative.
#pragma once

#include <cstddef>
#include <vector>

namespace hookpoint::control {

/// Through points (time[i], value[i]): straight lines, or cubics that join with equal slopes.
class Curve {
 public:
  enum class Shape { linear, cubic };
  struct Sample {
    double value;  ///< unit of the values
    double rate;   ///< unit of the values / s
  };

  /// `time` [s] increases strictly, as many as `value`, at least one. `closed`: what follows the
  /// last point is the first again (their values agree), so that the slope there is that of the
  /// round.
  Curve(std::vector<double> time, std::vector<double> value, Shape shape, bool closed);

  /// At `time` [s], before the first and after the last point: held there, with rate 0. On a corner
  /// of straight lines: the rate of the line that begins there. O(log n), allocates nothing.
  Sample at(double time) const;

 private:
  double slope_at(std::size_t point, bool closed) const;

  std::vector<double> time_, value_;
  std::vector<double> slope_;  // of the cubics at the points; empty: straight lines
};

}  // namespace hookpoint::control
