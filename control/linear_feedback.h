// What a component says of itself about a rest, for the largest stable step: which of its outputs
// follows which of its inputs, and how (Component::linearise).
#pragma once

#include <cstddef>
#include <optional>
#include <span>

namespace hookpoint::control {

/// output = -proportional x - derivative D - integral (integral of x dt), x the input's deviation
/// from where it rests, D its rate. Exactly: what `feedback` does in an update. All zero: nothing.
struct FeedbackGains {
  double proportional = 0.;  ///< [output per input]
  double derivative = 0.;    ///< [output s per input]
  double integral = 0.;      ///< [output per input and s]
  double filter_time = 0.;   ///< time constant of the low-pass filter of D [s]; 0: none
  bool differenced = false;  ///< D from successive samples of x, not from the input of the rate
};

/// One input's way to one output; ports by their `index()`.
struct LinearFeedback {
  std::size_t input = 0;                 ///< that brings x
  std::size_t output = 0;                ///< that follows it
  std::optional<std::size_t> rate = {};  ///< input that brings D; 0 if nothing drives it
  /// Input that x is held to: at rest, without an integral, output = proportional (goal - x). None
  /// where something else is added to that.
  std::optional<std::size_t> goal = {};
  FeedbackGains gains = {};
};

/// Numbers that `feedback` carries from one update to the next.
inline std::size_t memory_size(const FeedbackGains& gains) {
  return std::size_t{gains.differenced} + std::size_t{gains.filter_time > 0.} +
         std::size_t{gains.integral != 0.};
}

/// The output of an update that sees `x` and, unless differenced, its `rate`, `period` [s] after
/// the last: D = (x - x before)/T if differenced, D += (rate - D) T/(filter_time + T) if filtered,
/// and what the integral adds grows after the output. `memory` has `memory_size` numbers.
inline double feedback(const FeedbackGains& gains, double x, double rate, double period,
                       std::span<double> memory) {
  double* kept = memory.data();
  double derivative = rate;
  if (gains.differenced) {
    derivative = (x - *kept) / period;
    *kept++ = x;
  }
  if (gains.filter_time > 0.) {
    *kept += (derivative - *kept) * period / (gains.filter_time + period);
    derivative = *kept++;
  }
  double output = -gains.proportional * x - gains.derivative * derivative;
  if (gains.integral != 0.) {
    output += *kept;
    *kept -= gains.integral * x * period;
  }
  return output;
}

}  // namespace hookpoint::control
