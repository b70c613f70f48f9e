// Signals, Gain, Sum and Probe against closed forms.
#include <gtest/gtest.h>

#include <cmath>
#include <numbers>
#include <vector>

#include "tests/support/component_bench.h"

namespace hookpoint {
namespace {

using testing::ComponentBench;

TEST(Step, StepsAtTheTickOfItsTime) {
  // On steps of 1/3000 s, k times the step is less than k/3000 for k = 5, 7, 10, 14 and 17.
  for (const double per_second : {100., 3000.}) {
    for (const int k : {0, 1, 3, 5, 7, 10, 14, 17}) {
      ComponentBench step("Signal.Step", 1. / per_second);
      step["initial"] = -2.;
      step["final"] = 5.;
      step["start"] = k / per_second;
      step.start();
      for (int i = 0; i < 20; ++i) {
        step.tick();
        EXPECT_EQ(step["output"], i < k ? -2. : 5.) << k << " at " << i;
      }
    }
  }
}

TEST(Ramp, IsStraightBetweenItsEnds) {
  ComponentBench ramp("Signal.Ramp", 0.125);
  ramp["initial"] = 1.;
  ramp["final"] = 5.;
  ramp["start"] = 0.5;
  ramp["duration"] = 2.;
  ramp.start();
  for (int i = 0; i < 40; ++i) {
    const double t = i * 0.125;
    ramp.tick();
    EXPECT_EQ(ramp["output"], t < 0.5 ? 1. : t > 2.5 ? 5. : 1. + 2. * (t - 0.5)) << t;
  }
}

TEST(Ramp, OfNoDurationIsAStep) {
  ComponentBench ramp("Signal.Ramp", 0.5);
  ramp["start"] = 0.5;
  ramp["duration"] = 0.;
  ramp.tick();
  EXPECT_EQ(ramp["output"], 0.);
  ramp.tick();
  EXPECT_EQ(ramp["output"], 1.);
}

TEST(Sine, PassesThroughItsKnownValues) {
  ComponentBench sine("Signal.Sine", 0.125);  // 8 ticks a period
  sine["amplitude"] = 2.;
  sine["offset"] = 10.;
  const double half = std::numbers::sqrt2;
  for (const double deviation : {0., half, 2., half, 0., -half, -2., -half, 0.}) {
    sine.tick();
    EXPECT_NEAR(sine["output"], 10. + deviation, 1e-14);
  }
  sine["frequency"] = 2.;
  sine["phase"] = std::numbers::pi / 2.;
  sine.set_count(1);  // a quarter of a period after a maximum
  sine.tick();
  EXPECT_NEAR(sine["output"], 10., 1e-14);
  sine.tick();
  EXPECT_NEAR(sine["output"], 8., 1e-14);
}

std::vector<double> noise(double seed, int count) {
  ComponentBench bench("Signal.Noise");
  bench["mean"] = 3.;
  bench["standard_deviation"] = 0.5;
  bench["seed"] = seed;
  bench.start();
  std::vector<double> values(count);
  for (double& value : values) {
    bench.tick();
    value = bench["output"];
  }
  return values;
}

TEST(Noise, HasTheMeanVarianceAndIndependenceOfItsKind) {
  constexpr int n = 100000;
  const std::vector<double> values = noise(7., n);
  double mean = 0., variance = 0., covariance = 0., fourth = 0.;
  for (const double value : values) mean += value / n;
  for (int i = 0; i < n; ++i) {
    const double d = (values[i] - 3.) / 0.5;
    variance += d * d / n;
    fourth += d * d * d * d / n;
    if (i > 0) covariance += d * (values[i - 1] - 3.) / 0.5 / n;
  }
  // Five standard errors of each estimate: 1, sqrt(2), 1 and sqrt(96) over sqrt(n).
  const double error = 5. / std::sqrt(n);
  EXPECT_NEAR(mean, 3., 0.5 * error);
  EXPECT_NEAR(variance, 1., std::sqrt(2.) * error);
  EXPECT_NEAR(covariance, 0., error);
  EXPECT_NEAR(fourth, 3., std::sqrt(96.) * error);
}

TEST(Noise, DependsOnItsSeedAndTheTickAlone) {
  EXPECT_EQ(noise(7., 100), noise(7., 100));
  EXPECT_NE(noise(7., 100), noise(8., 100));
  ComponentBench late("Signal.Noise");
  late["mean"] = 3.;
  late["standard_deviation"] = 0.5;
  late["seed"] = 7.;
  late.start();
  late.set_count(99);
  late.tick();
  EXPECT_EQ(late["output"], noise(7., 100).back());
}

TEST(Gain, Multiplies) {
  ComponentBench gain("Gain");
  gain["input"] = 3.;
  gain.tick();
  EXPECT_EQ(gain["output"], 3.);
  gain["gain"] = -2.;
  gain.tick();
  EXPECT_EQ(gain["output"], -6.);
}

TEST(Sum, AddsEveryWeightedInput) {
  ComponentBench sum("Sum");
  double expected = 0.;
  for (int i = 0; i < 8; ++i) {
    sum["in[" + std::to_string(i) + "]"] = i + 1.;
    expected += i + 1.;
  }
  sum.tick();
  EXPECT_EQ(sum["output"], expected);
  sum["weight[7]"] = -1.;
  sum.tick();
  EXPECT_EQ(sum["output"], expected - 16.);
}

TEST(Probe, ShowsItsInput) {
  ComponentBench probe("Probe");
  probe["input"] = 4.25;
  probe.tick();
  EXPECT_EQ(probe["value"], 4.25);
}

}  // namespace
}  // namespace hookpoint
