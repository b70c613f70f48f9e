// What sampling and delay do to a feedback loop, against stability limits that are known in closed
// form. The plants are solved exactly on a step ten times finer than the sampling period, so the
// line's own sampling, holding and delay make the loop.
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <numbers>
#include <optional>

#include "control/core/transmission_line.h"

namespace hookpoint::control {
namespace {

constexpr int steps_per_sample = 10, samples = 40000;
const Rational dt(1, 1000), rate(100);
constexpr double step = 0.001, period = 0.01;

TransmissionLine line_delayed_by(int delay, double initial) {
  return {{.rate = rate, .delay = Rational(delay, 100), .initial = initial}, dt};
}

/// Largest magnitude in the last quarter of a run over that in the second: above 1 if it grows.
class Growth {
 public:
  void add(int sample, double magnitude) {
    const int quarter = 4 * sample / samples;
    if (quarter == 1) early_ = std::max(early_, magnitude);
    if (quarter == 3) late_ = std::max(late_, magnitude);
  }
  double ratio() const { return late_ / early_; }

 private:
  double early_ = 0., late_ = 0.;
};

/// x' = -gain y where y is x through the line. The line's output is constant from sample to sample,
/// so x moves on a straight line.
double growth_of_integrator(double gain, int delay) {
  TransmissionLine line = line_delayed_by(delay, 0.);
  Growth growth;
  double x = 1.;
  for (int k = 0; k < samples * steps_per_sample; ++k) {
    x -= step * gain * line.at(k, x);
    growth.add(k / steps_per_sample, std::abs(x));
  }
  return growth.ratio();
}

/// x' = -K x with d samples of delay: on the circle z = exp(i w) of z^(d+1) - z^d + K T = 0 the
/// smallest root has w = pi/(2 d + 1), and K T = 2 sin(pi/(2 (2 d + 1))).
TEST(DelayedFeedback, IntegratorIsStableUpToTheKnownGain) {
  for (const int delay : {0, 1, 2, 5}) {
    const double limit = 2. * std::sin(std::numbers::pi / (2. * (2. * delay + 1.))) / period;
    EXPECT_LT(growth_of_integrator(0.998 * limit, delay), 0.1) << delay;
    EXPECT_GT(growth_of_integrator(1.002 * limit, delay), 10.) << delay;
  }
}

/// angle'' = -(kp angle + 0.1 kp angle') with angle and rate through lines of the same delay: the
/// torque is constant from sample to sample, so the angle moves on a parabola.
double growth_of_double_integrator(double kp, int delay) {
  TransmissionLine angle_line = line_delayed_by(delay, 0.), rate_line = line_delayed_by(delay, 0.);
  Growth growth;
  double angle = 1., angle_rate = 0.;
  for (int k = 0; k < samples * steps_per_sample; ++k) {
    const double torque = -kp * (angle_line.at(k, angle) + 0.1 * rate_line.at(k, angle_rate));
    angle += step * angle_rate + 0.5 * step * step * torque;
    angle_rate += step * torque;
    growth.add(k / steps_per_sample, std::abs(angle));
  }
  return growth.ratio();
}

/// The roots of z^d (z - 1)^2 + kp (T^2/2 (z + 1) + 0.1 T (z - 1)) = 0 leave the circle at these
/// gains, T = 10 ms; without delay at z = -1: 4 = 2 T 0.1 kp.
TEST(DelayedFeedback, ProportionalDerivativeIsStableUpToTheKnownGain) {
  const std::pair<int, double> limits[] = {{0, 2000.}, {1, 941.83}, {2, 543.93}, {5, 181.29}};
  for (const auto& [delay, limit] : limits) {
    EXPECT_LT(growth_of_double_integrator(0.999 * limit, delay), 0.5) << delay;
    EXPECT_GT(growth_of_double_integrator(1.001 * limit, delay), 2.) << delay;
  }
}

/// A delay of a fraction of a sample arrives within the hold: between those of whole samples on
/// either side.
TEST(DelayedFeedback, HalfASampleCostsHalfAsMuch) {
  const auto growth = [](double gain) {
    TransmissionLine line({.rate = rate, .delay = Rational(5, 1000)}, dt);
    Growth result;
    double x = 1.;
    for (int k = 0; k < samples * steps_per_sample; ++k) {
      x -= step * gain * line.at(k, x);
      result.add(k / steps_per_sample, std::abs(x));
    }
    return result.ratio();
  };
  // x+ = x - K T (x + x_before)/2: z^2 + (a - 1) z + a = 0 with a = K T/2 has |z|^2 = a, so K T
  // = 2.
  EXPECT_LT(growth(0.998 * 2. / period), 0.1);
  EXPECT_GT(growth(1.002 * 2. / period), 10.);
}

}  // namespace
}  // namespace hookpoint::control
