// Filter, Switch, Sample and Delay against closed forms: the analog prototypes at the frequency
// that the bilinear transform maps to, and what the words in the documentation say, update by
// update.
#include <gtest/gtest.h>

#include <cmath>
#include <complex>
#include <numbers>

#include "tests/support/component_bench.h"

namespace hookpoint {
namespace {

using testing::ComponentBench;
using testing::start_error;
using Complex = std::complex<double>;

constexpr double pi = std::numbers::pi;

/// The analog filter's transfer function at s = i W.
Complex prototype(const std::string& kind, int order, double corner, double quality, double W) {
  const Complex s{0., W};
  const double w0 = 2. * pi * corner;
  if (order == 1) return (kind == "low_pass" ? Complex{w0} : s) / (s + w0);
  const Complex whole = s * s + w0 * s / quality + w0 * w0;
  if (kind == "low_pass") return w0 * w0 / whole;
  return (kind == "high_pass" ? s * s : w0 * s / quality) / whole;
}

/// The transfer function of the component at `frequency`: the response to a sine, once settled, by
/// its projection on the sine over whole periods.
Complex measured(ComponentBench& filter, double frequency, double period) {
  const auto whole = static_cast<std::int64_t>(std::lround(1. / (frequency * period)));
  const std::int64_t settled = 400 * whole, last = settled + 20 * whole;
  Complex sum;
  for (std::int64_t k = 0; k < last; ++k) {
    const double phase = 2. * pi * static_cast<double>(k % whole) / static_cast<double>(whole);
    filter["input"] = std::sin(phase);
    filter.tick();
    if (k >= settled) sum += filter["output"] * std::polar(1., -phase);
  }
  // sin = Im exp(i phase): the projection of Im(H exp(i phase)) is H/(2 i).
  return sum * Complex{0., 2.} / static_cast<double>(last - settled);
}

TEST(Filter, HasTheGainAndPhaseOfTheAnalogOneAtTheWarpedFrequency) {
  const double period = 1e-3, corner = 50.;
  struct Case {
    const char* kind;
    int order;
    double quality;
  };
  for (const Case& one :
       {Case{"low_pass", 1, 1.}, Case{"low_pass", 2, std::sqrt(0.5)}, Case{"low_pass", 2, 3.},
        Case{"high_pass", 1, 1.}, Case{"high_pass", 2, 0.5}, Case{"band_pass", 2, 5.}}) {
    for (const double frequency : {10., 50., 125., 250.}) {
      ComponentBench filter("Filter", period);
      filter.text("kind", one.kind);
      filter["frequency"] = corner;
      filter["order"] = one.order;
      filter["quality"] = one.quality;
      filter.start();
      // The digital frequency f is the analog W = w0 tan(pi f T)/tan(pi f0 T).
      const double W =
          2. * pi * corner * std::tan(pi * frequency * period) / std::tan(pi * corner * period);
      const Complex expected = prototype(one.kind, one.order, corner, one.quality, W);
      EXPECT_LT(std::abs(measured(filter, frequency, period) - expected), 1e-9)
          << one.kind << " " << one.order << " at " << frequency << " Hz";
    }
  }
}

TEST(Filter, StartsAtRestUnderItsFirstInput) {
  for (const auto& [kind, rest] :
       {std::pair{"low_pass", 3.}, {"high_pass", 0.}, {"band_pass", 0.}}) {
    ComponentBench filter("Filter");
    filter.text("kind", kind);
    filter["input"] = 3.;
    filter.start();
    for (int i = 0; i < 50; ++i) {
      filter.tick();
      EXPECT_NEAR(filter["output"], rest, 1e-12) << kind;
    }
  }
}

TEST(Filter, RefusesACornerThatTheUpdatesCannotCarry) {
  ComponentBench filter("Filter", 1e-3);
  filter["frequency"] = 500.;
  EXPECT_NE(start_error(filter).find("half of the updates"), std::string::npos);
  filter["frequency"] = 499.;
  EXPECT_EQ(start_error(filter), "");
  filter["order"] = 1.5;
  EXPECT_NE(start_error(filter).find("order"), std::string::npos);
  filter["order"] = 1.;
  filter.text("kind", "band_pass");
  EXPECT_NE(start_error(filter).find("band_pass"), std::string::npos);
}

TEST(Switch, TremblingAboutTheThresholdDoesNotSwitchBack) {
  ComponentBench change("Switch");
  change["in[0]"] = 10.;
  change["in[1]"] = 20.;
  change["threshold"] = 1.;
  change["hysteresis"] = 0.25;
  change.start();
  const auto at = [&](double control) {
    change["control"] = control;
    change.tick();
    return change["output"];
  };
  EXPECT_EQ(at(0.99), 10.);
  EXPECT_EQ(at(1.), 20.);
  EXPECT_EQ(at(0.75), 20.);
  EXPECT_EQ(at(0.74), 10.);
  EXPECT_EQ(change["on"], 0.);
  EXPECT_EQ(at(0.99), 10.);
}

TEST(Sample, HoldsWhatWasThereWhenTheTriggerRose) {
  ComponentBench sample("Sample");
  sample["initial"] = -1.;
  sample.drive("trigger", 0.);
  sample.start();
  const auto at = [&](double input, double trigger) {
    sample["input"] = input;
    sample.drive("trigger", trigger);
    sample.tick();
    return sample["output"];
  };
  EXPECT_EQ(at(1., 0.), -1.);
  EXPECT_EQ(at(2., 1.), 2.);
  EXPECT_EQ(at(3., 1.), 2.);
  EXPECT_EQ(at(4., 0.), 2.);
  EXPECT_EQ(at(5., 0.6), 5.);
  ComponentBench each("Sample");
  each.start();
  each["input"] = 7.;
  each.tick();
  EXPECT_EQ(each["output"], 7.);
}

TEST(Delay, IsTheInputOfSoManyUpdatesAgo) {
  for (const auto& [time, updates] : {std::pair{0., 0}, {3e-3, 3}, {2.5e-3, 3}, {0.256, 256}}) {
    ComponentBench delay("Delay", 1e-3);
    delay["time"] = time;
    delay["initial"] = -1.;
    delay.start();
    for (int k = 0; k < 600; ++k) {
      delay["input"] = k;
      delay.tick();
      EXPECT_EQ(delay["output"], k < updates ? -1. : k - updates) << time << " s, update " << k;
    }
  }
  ComponentBench longer("Delay", 1e-3);
  longer["time"] = 0.257;
  EXPECT_NE(start_error(longer).find("256 updates"), std::string::npos);
}

}  // namespace
}  // namespace hookpoint
