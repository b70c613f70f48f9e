// The gait of independent legs: what emerges from the rules, from any beginning.
#include <gtest/gtest.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <random>
#include <stdexcept>
#include <vector>

#include "tests/support/allocation_counter.h"
#include "tests/support/hexapod_gait_bench.h"

namespace hookpoint::testing {
namespace {

constexpr double dt = 2e-3;
constexpr double stride = 0.05, swing_duration = 0.25;

bool neighbours(std::size_t a, std::size_t b) {
  return (a / 3 == b / 3 && (a > b ? a - b : b - a) == 1) || a % 3 == b % 3;
}

struct Walk {
  std::array<std::vector<double>, legs> lift_offs;  ///< after settling [s]
  std::size_t fewest = legs;                        ///< legs in stance, after settling
  int overlaps = 0;        ///< updates with two neighbours in swing, after settling
  int early_overlaps = 0;  ///< the same before
  double pace = 1.;        ///< least, after settling
};

Walk walk(HexapodGaitBench& bench, double settling, double duration) {
  Walk result;
  bench.start(dt);
  while (bench.time() < settling + duration) {
    std::array<bool, legs> stood{};
    for (std::size_t leg = 0; leg < legs; ++leg) stood[leg] = bench.stance(leg);
    bench.update();
    std::size_t standing = 0;
    bool overlap = false;
    for (std::size_t leg = 0; leg < legs; ++leg) {
      standing += bench.stance(leg) ? 1 : 0;
      for (std::size_t other = 0; other < leg; ++other) {
        overlap |= neighbours(leg, other) && !bench.stance(leg) && !bench.stance(other);
      }
      if (stood[leg] && !bench.stance(leg) && bench.time() > settling)
        result.lift_offs[leg].push_back(bench.time());
    }
    if (bench.time() <= settling) {
      result.early_overlaps += overlap ? 1 : 0;
    } else {
      result.overlaps += overlap ? 1 : 0;
      result.fewest = std::min(result.fewest, standing);
      result.pace = std::min(result.pace, bench.get("pace"));
    }
  }
  return result;
}

double cycle(const Walk& walked, std::size_t leg) {
  const std::vector<double>& times = walked.lift_offs[leg];
  if (times.size() < 2) return std::nan("");
  return (times.back() - times.front()) / double(times.size() - 1);
}

/// How much later than `from` the leg `to` lifts off, in cycles, 0 to 1.
double lag(const Walk& walked, std::size_t from, std::size_t to) {
  if (walked.lift_offs[from].size() < 3 || walked.lift_offs[to].size() < 3) return std::nan("");
  const double begin = walked.lift_offs[from][1];
  const auto next = std::ranges::lower_bound(walked.lift_offs[to], begin - 2. * dt);
  const double share = (*next - begin) / cycle(walked, from);
  return share - std::floor(share);
}

double distance_on_circle(double a, double b) { return std::abs(std::remainder(a - b, 1.)); }

/// Gaits with all legs begun somewhere in their stance.
HexapodGaitBench begun_anywhere(std::mt19937& random, double speed) {
  HexapodGaitBench bench{"Controller.CruseGait"};
  std::uniform_real_distribution<double> unit(0., 1.);
  for (std::size_t leg = 0; leg < legs; ++leg) bench.set("initial_phase", leg, unit(random));
  bench.set("forward", speed);
  return bench;
}

TEST(CruseGait, FastLegsSettleInATripodFromAnyBeginning) {
  std::mt19937 random(11);
  for (int trial = 0; trial < 10; ++trial) {
    HexapodGaitBench bench = begun_anywhere(random, stride / swing_duration);
    const Walk walked = walk(bench, 20., 5.);
    EXPECT_EQ(walked.overlaps, 0);
    EXPECT_EQ(walked.early_overlaps, 0);
    EXPECT_EQ(walked.fewest, 3U);
    for (std::size_t leg = 1; leg < legs; ++leg) {
      EXPECT_LT(distance_on_circle(lag(walked, 0, leg), leg % 2 == 0 ? 0. : 0.5), 0.02) << leg;
    }
    // Duty factor one half: a stance as short as the swing.
    EXPECT_NEAR(cycle(walked, 0), 2. * swing_duration, 0.01);
  }
}

TEST(CruseGait, SlowLegsSettleInWavesFromRearToFront) {
  std::mt19937 random(12);
  for (const double speed : {0.1, 0.05}) {
    for (int trial = 0; trial < 6; ++trial) {
      HexapodGaitBench bench = begun_anywhere(random, speed);
      const Walk walked = walk(bench, 30., 6.);
      EXPECT_EQ(walked.overlaps + walked.early_overlaps, 0);
      EXPECT_GE(walked.fewest, 4U);
      EXPECT_GT(walked.pace, 0.99);
      for (const std::size_t hind : {0, 3}) {
        // Rule 2: a leg lifts off as the one behind it touches down, one swing later.
        const double one_swing = swing_duration / cycle(walked, hind);
        EXPECT_LT(one_swing, 0.4);
        EXPECT_LT(distance_on_circle(lag(walked, hind, hind + 1), one_swing), 0.03);
        EXPECT_LT(distance_on_circle(lag(walked, hind + 1, hind + 2), one_swing), 0.03);
      }
    }
  }
}

TEST(CruseGait, RulesOneToThreeAloneMakeTheWave) {
  // Without the veto of a loaded leg neighbours may swing together at first; the wave forms all the
  // same.
  std::mt19937 random(13);
  int early = 0;
  for (int trial = 0; trial < 6; ++trial) {
    HexapodGaitBench bench = begun_anywhere(random, 0.1);
    bench.set("load", 0.);
    const Walk walked = walk(bench, 30., 6.);
    early += walked.early_overlaps;
    for (const std::size_t hind : {0, 3}) {
      EXPECT_LT(
          distance_on_circle(lag(walked, hind, hind + 1), swing_duration / cycle(walked, hind)),
          0.03);
    }
  }
  EXPECT_GT(early, 0);
}

TEST(CruseGait, WithoutRulesNothingCoordinates) {
  std::mt19937 random(14);
  HexapodGaitBench bench = begun_anywhere(random, 0.1);
  for (const char* rule : {"rule1", "rule2", "rule3", "rule3_across", "load"}) bench.set(rule, 0.);
  const Walk walked = walk(bench, 30., 6.);
  EXPECT_GT(walked.overlaps, 0);
  // Each leg keeps its own cycle of stance and swing.
  for (std::size_t leg = 0; leg < legs; ++leg)
    EXPECT_NEAR(cycle(walked, leg), stride / 0.1 + swing_duration, 0.01);
}

TEST(CruseGait, EachRuleShiftsTheLiftOffByItsWeight) {
  // Leg 1 is watched, alone near the end of its stance; its neighbours do what the rule speaks of.
  const auto lift_off = [](double rule1, double rule2, double rule3, double across,
                           std::array<double, legs> begin, double rule2_time = 0.25) {
    HexapodGaitBench bench{"Controller.CruseGait"};
    bench.set("forward", 0.1);
    bench.set("command_lag", 0.);
    bench.set("rule1", rule1);
    bench.set("rule2", rule2);
    bench.set("rule2_time", rule2_time);
    bench.set("rule3", rule3);
    bench.set("rule3_across", across);
    bench.set("load", 0.);
    bench.set("overreach", 10.);  // a leg that waits does not slow the body
    for (std::size_t leg = 0; leg < legs; ++leg) bench.set("initial_phase", leg, begin[leg]);
    bench.start(dt);
    for (int k = 0; k < 2000; ++k) {
      const double x = bench.foot(1).x;
      const bool walking = bench.get("placed") >= 2.;
      bench.update();
      if (walking && !bench.stance(1)) return 0.5 - (x - bench.neutral(1).x) / stride;
    }
    return -1.;
  };
  const double tick = 2. * 0.1 * dt / stride;
  // Nothing said: the posterior extreme position.
  EXPECT_NEAR(lift_off(0., 0., 0., 0., {0.1, 0.6, 0.1, 0.1, 0.1, 0.1}), 1., tick);
  // Rule 1: leg 0 lifts off 0.1 strides before leg 1 would and swings for half a stride.
  EXPECT_NEAR(lift_off(0.2, 0., 0., 0., {0.7, 0.6, 0.1, 0.1, 0.1, 0.1}), 1.2, tick);
  // ... which is over when the swing is, 0.6 strides after the beginning.
  EXPECT_NEAR(lift_off(0.9, 0., 0., 0., {0.9, 0.6, 0.1, 0.1, 0.1, 0.1}), 1.2, 2. * tick);
  // Rule 2: leg 0 touches down 0.6 strides after the beginning, leg 1 is then at 0.85.
  EXPECT_NEAR(lift_off(0., 0.2, 0., 0., {0.9, 0.25, 0.1, 0.1, 0.1, 0.1}), 0.85, 2. * tick);
  // ... for as long as rule2_time: leg 1, at 0.7 then, needs 0.05 s to 0.8.
  EXPECT_NEAR(lift_off(0., 0.2, 0., 0., {0.9, 0.1, 0.1, 0.1, 0.1, 0.1}, 0.06), 0.8, 2. * tick);
  EXPECT_NEAR(lift_off(0., 0.2, 0., 0., {0.9, 0.1, 0.1, 0.1, 0.1, 0.1}, 0.04), 1., 2. * tick);
  // Rule 3: leg 2 is as far, L = 1 - w (2 L - 1): L = (1 + w)/(1 + 2 w).
  EXPECT_NEAR(lift_off(0., 0., 0.5, 0., {0.1, 0.6, 0.6, 0.1, 0.1, 0.1}), 0.75, tick);
  EXPECT_NEAR(lift_off(0., 0., 0., 0.5, {0.1, 0.6, 0.1, 0.1, 0.6, 0.1}), 0.75, tick);
  // ... and nothing before its neutral position.
  EXPECT_NEAR(lift_off(0., 0., 0.5, 0., {0.1, 0.6, 0.05, 0.1, 0.1, 0.1}), 1., tick);
}

TEST(CruseGait, StanceFeetMoveWithTheCommand) {
  HexapodGaitBench bench{"Controller.CruseGait"};
  bench.set("forward", 0.05);
  bench.set("turn", 0.1);
  bench.start(dt);
  while (bench.time() < 8.) bench.update();
  int seen = 0;
  for (int k = 0; k < 500; ++k) {
    std::array<Vector3d, legs> before;
    std::array<bool, legs> stood{};
    for (std::size_t leg = 0; leg < legs; ++leg) {
      before[leg] = bench.foot(leg);
      stood[leg] = bench.stance(leg);
    }
    bench.update();
    for (std::size_t leg = 0; leg < legs; ++leg) {
      if (!stood[leg] || !bench.stance(leg) || bench.get("pace") < 1.) continue;
      const Vector3d velocity = (1. / dt) * (bench.foot(leg) - before[leg]);
      const Vector3d middle = 0.5 * (bench.foot(leg) + before[leg]);
      EXPECT_NEAR(velocity.x, -0.05 + 0.1 * middle.y, 1e-8);
      EXPECT_NEAR(velocity.y, -0.1 * middle.x, 1e-8);
      ++seen;
    }
  }
  EXPECT_GT(seen, 1000);
}

TEST(CruseGait, MoreThanTheLegsCanStepIsNotFollowed) {
  HexapodGaitBench bench{"Controller.CruseGait"};
  bench.set("forward", 1.);
  bench.start(dt);
  std::array<Vector3d, legs> before;
  double fastest = 0., slowest = 0.;
  for (int k = 0; k < 5000; ++k) {
    for (std::size_t leg = 0; leg < legs; ++leg) before[leg] = bench.foot(leg);
    bench.update();
    for (std::size_t leg = 0; leg < legs; ++leg) {
      const Vector3d velocity = (1. / dt) * (bench.foot(leg) - before[leg]);
      fastest = std::max(fastest, norm(velocity));
      if (bench.stance(leg)) slowest = std::min(slowest, velocity.x);
    }
  }
  EXPECT_NEAR(slowest, -stride / swing_duration, 1e-3);
  // Swing: up 3.4346 h / T, forwards 3/2 (stride + v T)/T over the ground; the pace of waiting legs
  // adds less than v once more.
  EXPECT_LT(fastest, std::hypot(3.4346 * 0.03, 1.5 * 2. * stride + stride) / swing_duration);
}

TEST(CruseGait, StandsWithoutACommandAndTurnsOnTheSpot) {
  HexapodGaitBench bench{"Controller.CruseGait"};
  bench.start(dt);
  for (int k = 0; k < 2000; ++k) {
    bench.update();
    for (std::size_t leg = 0; leg < legs; ++leg) EXPECT_TRUE(bench.stance(leg));
  }
  HexapodGaitBench turning{"Controller.CruseGait"};
  turning.set("turn", 0.4);
  const Walk walked = walk(turning, 20., 10.);
  EXPECT_EQ(walked.overlaps, 0);
  EXPECT_GE(walked.fewest, 3U);
  for (std::size_t leg = 0; leg < legs; ++leg) EXPECT_GE(walked.lift_offs[leg].size(), 8U);
}

TEST(CruseGait, ResumesFromItsValues) {
  std::mt19937 random(15);
  HexapodGaitBench bench = begun_anywhere(random, 0.12);
  bench.start(dt);
  while (bench.time() < 3.3) bench.update();
  EXPECT_TRUE(resumes_from_its_values(bench, "Controller.CruseGait", dt));
}

TEST(CruseGait, UpdatesAllocateNothing) {
  HexapodGaitBench bench{"Controller.CruseGait"};
  bench.set("forward", 0.1);
  bench.start(dt);
  control::Component& gait = bench.component();
  const long before = allocation_count();
  for (std::int64_t k = 0; k < 2000; ++k) gait.update({double(k) * dt, dt, k});
  EXPECT_EQ(allocation_count(), before);
}

}  // namespace
}  // namespace hookpoint::testing
