// Transmission lines against sequences worked by hand. The source's value at step k is k, so the
// output says which step's sample is seen; -1 is the port's initial value.
#include <gtest/gtest.h>

#include <cmath>
#include <stdexcept>
#include <string>
#include <vector>

#include "control/core/transmission_line.h"
#include "tests/support/allocation_counter.h"

namespace hookpoint::control {
namespace {

const Rational millisecond(1, 1000);

std::vector<double> outputs(const LineDescription& description, const Rational& dt, int steps) {
  TransmissionLine line(description, dt);
  std::vector<double> seen;
  for (int k = 0; k < steps; ++k) {
    seen.push_back(line.at(k, k));
    EXPECT_EQ(line.output(), seen.back());
  }
  return seen;
}

LineDescription line_of(std::optional<Rational> rate, Rational delay) {
  return {.rate = rate, .delay = delay, .initial = -1.};
}

using Sequence = std::vector<double>;

TEST(TransmissionLine, WithoutPropertiesIsAWire) {
  EXPECT_EQ(outputs(line_of({}, 0), millisecond, 5), (Sequence{0, 1, 2, 3, 4}));
}

TEST(TransmissionLine, ThreeHundredHertzOnAMillisecond) {
  EXPECT_EQ(outputs(line_of(Rational(300), 0), millisecond, 15),
            (Sequence{0, 0, 0, 0, 4, 4, 4, 7, 7, 7, 10, 10, 10, 10, 14}));
}

// The source is k at step k: samples at 0, 4, 7, 10, 14 are the means of 0; 1 ... 4; 5 ... 7; 8 ... 10; 11 ... 14.
TEST(TransmissionLine, MeanSinceTheLastSample) {
  LineDescription mean = line_of(Rational(300), 0);
  mean.mean = true;
  EXPECT_EQ(outputs(mean, millisecond, 15),
            (Sequence{0, 0, 0, 0, 2.5, 2.5, 2.5, 6, 6, 6, 9, 9, 9, 9, 12.5}));
  mean.delay = Rational(5, 2000);
  EXPECT_EQ(outputs(mean, millisecond, 18),
            (Sequence{-1, -1, -1, 0, 0, 0, 0, 2.5, 2.5, 2.5, 6, 6, 6, 9, 9, 9, 9, 12.5}));
  mean.rate.reset();
  mean.delay = 0;
  EXPECT_EQ(outputs(mean, millisecond, 4), (Sequence{0, 1, 2, 3}));
}

TEST(TransmissionLine, MeanResumesInTheMidstOfASum) {
  LineDescription description = line_of(Rational(300), Rational(5, 2000));
  description.mean = true;
  TransmissionLine line(description, millisecond);
  for (int k = 0; k < 9; ++k) line.at(k, k);
  std::vector<double> state(line.state_size());
  line.save(state);
  TransmissionLine resumed(description, millisecond);
  resumed.restore(8, state);
  for (int k = 9; k < 40; ++k) EXPECT_EQ(resumed.at(k, k), line.at(k, k)) << k;
}

// A run has at most 2^53 steps.
TEST(TransmissionLine, DelayThatNoRunLastsIsRefused) {
  const Rational rare(1, std::int64_t{1} << 40), longest(std::int64_t{1} << 53);
  EXPECT_NO_THROW(TransmissionLine(line_of(rare, longest), Rational(1)));
  EXPECT_THROW(TransmissionLine(line_of(rare, longest + Rational(1)), Rational(1)),
               std::invalid_argument);
}

TEST(TransmissionLine, DelayThatIsNoWholeStep) {
  // Samples at 0, 4, 7, 10, 14 and 2.5 ms later: at the steps 3, 7, 10, 13, 17.
  EXPECT_EQ(outputs(line_of(Rational(300), Rational(5, 2000)), millisecond, 18),
            (Sequence{-1, -1, -1, 0, 0, 0, 0, 4, 4, 4, 7, 7, 7, 10, 10, 10, 10, 14}));
}

TEST(TransmissionLine, DelayOfEveryStep) {
  EXPECT_EQ(outputs(line_of({}, Rational(3, 1000)), millisecond, 7),
            (Sequence{-1, -1, -1, 0, 1, 2, 3}));
}

TEST(TransmissionLine, DelayLongerThanTheSamplingPeriod) {
  // 200 Hz, 12 ms: samples at 0, 5, 10 are all under way before the first arrives at 12, then
  // 17, 22.
  const Sequence seen = outputs(line_of(Rational(200), Rational(12, 1000)), millisecond, 28);
  for (int k = 0; k < 28; ++k) {
    EXPECT_EQ(seen[k], k < 12 ? -1 : k < 17 ? 0 : k < 22 ? 5 : k < 27 ? 10 : 15) << k;
  }
}

TEST(TransmissionLine, StepThatDoesNotDivideThePeriod) {
  // 1 kHz on 0.3 ms: 10/3 steps a sample; a delay of 1 ms is 10/3 steps too and arrives at the
  // fourth.
  EXPECT_EQ(outputs(line_of(Rational(1000), millisecond), Rational(3, 10000), 15),
            (Sequence{-1, -1, -1, -1, 0, 0, 0, 0, 4, 4, 4, 7, 7, 7, 10}));
}

TEST(TransmissionLine, RateAboveTheStepsIsEveryStep) {
  EXPECT_EQ(outputs(line_of(Rational(3000), 0), millisecond, 4), (Sequence{0, 1, 2, 3}));
  EXPECT_EQ(outputs(line_of(Rational(1000), 0), millisecond, 4), (Sequence{0, 1, 2, 3}));
  EXPECT_EQ(outputs(line_of(Rational(1000001, 1001), 0), millisecond, 4), (Sequence{0, 0, 2, 3}));
}

TEST(TransmissionLine, SlowRateAndLongDelay) {
  // 0.4 Hz on 1 s: samples at 0, 3 (2.5), 5, 8 (7.5), 10; 4 s later.
  EXPECT_EQ(outputs(line_of(Rational(2, 5), 4), 1, 13),
            (Sequence{-1, -1, -1, -1, 0, 0, 0, 3, 3, 5, 5, 5, 8}));
}

TEST(Schedule, DoesNotJitterHoweverLong) {
  // Of a rate of 300 Hz on 1 ms, step k is due when k = ceil(10 n/3): exactly the k with k mod 10
  // in {0, 4, 7}.
  Schedule schedule(Rational::from(300.), Rational::from(0.001));
  for (std::int64_t k = 0; k < 3'000'000; ++k) {
    ASSERT_EQ(schedule.due(k), k % 10 == 0 || k % 10 == 4 || k % 10 == 7) << k;
  }
  EXPECT_EQ(schedule.count(), 900'000);
  // Three thousand years later.
  schedule.resume(30'000'000'000'001);
  for (std::int64_t k = 100'000'000'000'001; k < 100'000'000'000'041; ++k) {
    ASSERT_EQ(schedule.due(k), k % 10 == 0 || k % 10 == 4 || k % 10 == 7) << k;
  }
}

TEST(Schedule, PeriodIsThatOfTheRate) {
  EXPECT_EQ(Schedule(Rational(300), millisecond).period(), 1. / 300.);
  EXPECT_EQ(Schedule({}, millisecond).period(), 0.001);
  EXPECT_EQ(Schedule(Rational(5000), millisecond).period(), 0.001);
}

TEST(TransmissionLine, RefusesNonsense) {
  EXPECT_THROW(TransmissionLine(line_of(Rational(0), 0), millisecond), std::invalid_argument);
  EXPECT_THROW(TransmissionLine(line_of(Rational(-5), 0), millisecond), std::invalid_argument);
  EXPECT_THROW(TransmissionLine(line_of({}, Rational(-1, 100)), millisecond),
               std::invalid_argument);
  EXPECT_THROW(TransmissionLine(line_of({}, 0), 0), std::invalid_argument);
  EXPECT_THROW(TransmissionLine(line_of({}, 1'000'000), millisecond), std::invalid_argument);
  LineDescription noisy;
  noisy.noise = -1.;
  EXPECT_THROW(TransmissionLine(noisy, millisecond), std::invalid_argument);
}

LineDescription noisy_line(std::optional<Rational> rate, Rational delay, const std::string& place) {
  return {.rate = rate, .delay = delay, .noise = 0.5, .stream_seed = stream_key(1, place)};
}

TEST(TransmissionNoise, IsWhiteWithTheStatedDeviation) {
  constexpr int steps = 100000;
  TransmissionLine line(noisy_line({}, 0, "a"), millisecond);
  std::vector<double> noise;
  double mean = 0., square = 0.;
  for (int k = 0; k < steps; ++k) {
    noise.push_back(line.at(k, 2.) - 2.);
    mean += noise.back() / steps;
    square += noise.back() * noise.back() / steps;
  }
  const double root = std::sqrt(steps);
  EXPECT_NEAR(mean, 0., 4. * 0.5 / root);
  EXPECT_NEAR(square, 0.25, 4. * 0.25 * std::sqrt(2.) / root);
  for (int shift = 1; shift < 6; ++shift) {
    double correlation = 0.;
    for (int k = shift; k < steps; ++k) correlation += noise[k] * noise[k - shift] / (0.25 * steps);
    EXPECT_NEAR(correlation, 0., 4. / root) << shift;
  }
}

TEST(TransmissionNoise, JoinsAtTheSamplingInstantAndIsHeldWithTheSample) {
  TransmissionLine every_step(noisy_line({}, 0, "a"), millisecond);
  TransmissionLine sampled(noisy_line(Rational(100), 0, "a"), millisecond);
  TransmissionLine delayed(noisy_line(Rational(100), Rational(7, 1000), "a"), millisecond);
  std::vector<double> noise, held, late;
  for (int k = 0; k < 1000; ++k) {
    noise.push_back(every_step.at(k, 0.));
    held.push_back(sampled.at(k, 0.));
    late.push_back(delayed.at(k, 0.));
  }
  for (int k = 0; k < 1000; ++k) {
    // The n-th sample carries the n-th number of the stream, whenever it is taken.
    EXPECT_EQ(held[k], noise[k / 10]) << k;
    if (k < 7) continue;
    EXPECT_EQ(late[k], held[k - 7]) << k;
  }
}

TEST(TransmissionNoise, IsRepeatableAndOfNoOtherLinesConcern) {
  const LineDescription description = noisy_line(Rational(250), 0, "a -> b");
  TransmissionLine alone(description, millisecond), beside(description, millisecond);
  TransmissionLine other(noisy_line({}, 0, "c -> d"), millisecond);
  int equal = 0;
  for (int k = 0; k < 1000; ++k) {
    const double noise = other.at(k, 0.);
    const double value = alone.at(k, 0.);
    ASSERT_EQ(value, beside.at(k, 0.));
    equal += noise == value ? 1 : 0;
  }
  EXPECT_EQ(equal, 0);
}

TEST(TransmissionLine, ACopyAndASavedStateGoOnAlike) {
  LineDescription description = noisy_line(Rational(300), Rational(17, 2000), "a");
  description.initial = -1.;
  TransmissionLine line(description, millisecond);
  for (int k = 0; k < 1237; ++k) line.at(k, std::sin(k));
  TransmissionLine copy = line, restored(description, millisecond);
  std::vector<double> state(line.state_size());
  line.save(state);
  restored.restore(1236, state);
  EXPECT_EQ(restored.output(), line.output());
  for (int k = 1237; k < 2000; ++k) {
    const double expected = line.at(k, std::sin(k));
    ASSERT_EQ(copy.at(k, std::sin(k)), expected);
    ASSERT_EQ(restored.at(k, std::sin(k)), expected);
  }
}

TEST(TransmissionLine, ARestoredLineWaitsForItsFirstSample) {
  const LineDescription description = line_of(Rational(100), Rational(25, 1000));
  TransmissionLine line(description, millisecond), restored(description, millisecond);
  for (int k = 0; k < 12; ++k) line.at(k, k);
  std::vector<double> state(line.state_size());
  line.save(state);
  restored.restore(11, state);
  for (int k = 12; k < 40; ++k) {
    EXPECT_EQ(restored.at(k, k), k < 25 ? -1 : k < 35 ? 0 : 10) << k;
  }
}

TEST(TransmissionLine, ADelayedSampleMayBeDeliveredBeforeTheNextIsTaken) {
  for (const auto& rate : {std::optional<Rational>(), std::optional<Rational>(300)}) {
    const LineDescription description = line_of(rate, Rational(25, 10000));
    TransmissionLine line(description, millisecond), halves(description, millisecond);
    EXPECT_TRUE(line.delayed());
    for (int k = 0; k < 200; ++k) {
      const double delivered = halves.deliver(k);
      halves.sample(k, k);
      ASSERT_EQ(delivered, line.at(k, k)) << k;
    }
  }
  EXPECT_FALSE(TransmissionLine(line_of({}, 0), millisecond).delayed());
}

TEST(TransmissionLine, AllocatesNothingOnItsWay) {
  TransmissionLine line(noisy_line(Rational(300), Rational(50, 1000), "a"), millisecond);
  const long before = testing::allocation_count();
  for (int k = 0; k < 5000; ++k) line.at(k, k);
  EXPECT_EQ(testing::allocation_count() - before, 0);
}

}  // namespace
}  // namespace hookpoint::control
