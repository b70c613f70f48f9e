// The tripod gait: which legs step when, and that stance feet move as the ground does.
#include <gtest/gtest.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <numbers>
#include <stdexcept>
#include <vector>

#include "tests/support/allocation_counter.h"
#include "tests/support/hexapod_gait_bench.h"

namespace hookpoint::testing {
namespace {

constexpr double dt = 1e-3;
constexpr double period = 0.6, duty = 0.6, stand = 0.2;

class TripodGait : public ::testing::Test {
 protected:
  TripodGait() {
    bench.set("period", period);
    bench.set("duty_factor", duty);
    bench.set("stand", stand);
  }
  void run_until(double time) {
    while (bench.time() < time - 0.5 * dt) bench.update();
  }
  HexapodGaitBench bench{"Controller.TripodGait"};
};

TEST_F(TripodGait, TwoTripodsHalfAPeriodApartForTheDutyFactor) {
  bench.set("forward", 0.08);
  bench.start(dt);
  run_until(3.);
  std::array<int, legs> stance{};
  constexpr int periods = 10;
  const int ticks = int(std::lround(periods * period / dt));
  int all = 0;
  for (int k = 0; k < ticks; ++k) {
    bench.update();
    int first = 0, second = 0;
    for (std::size_t leg = 0; leg < legs; ++leg) {
      stance[leg] += bench.stance(leg) ? 1 : 0;
      (leg % 2 == 0 ? first : second) += bench.stance(leg) ? 1 : 0;
    }
    // A tripod steps as one, and one of the two always stands.
    EXPECT_TRUE(first == 0 || first == 3);
    EXPECT_TRUE(second == 0 || second == 3);
    EXPECT_GE(first + second, 3);
    all += first + second == 6 ? 1 : 0;
  }
  for (std::size_t leg = 0; leg < legs; ++leg) EXPECT_NEAR(stance[leg], duty * ticks, periods);
  // Both tripods stand for what the duty factor leaves beyond one half, twice a period.
  EXPECT_NEAR(all, 2. * (duty - 0.5) * ticks, 2 * periods);
}

TEST_F(TripodGait, PhasesAreHalfAPeriodApart) {
  bench.set("forward", 0.08);
  bench.start(dt);
  run_until(2.);
  std::array<std::vector<double>, legs> lift_offs;
  std::array<bool, legs> stood{};
  while (bench.time() < 8.) {
    for (std::size_t leg = 0; leg < legs; ++leg) stood[leg] = bench.stance(leg);
    bench.update();
    for (std::size_t leg = 0; leg < legs; ++leg) {
      EXPECT_EQ(bench.stance(leg), bench.get("phase", leg) < 0.5) << bench.get("phase", leg);
      if (stood[leg] && !bench.stance(leg)) lift_offs[leg].push_back(bench.time());
    }
  }
  for (std::size_t leg = 0; leg < legs; ++leg) {
    ASSERT_GE(lift_offs[leg].size(), 9U);
    for (std::size_t i = 1; i < lift_offs[leg].size(); ++i) {
      EXPECT_NEAR(lift_offs[leg][i] - lift_offs[leg][i - 1], period, 2. * dt);
    }
    const double lag = std::fmod(std::abs(lift_offs[leg][3] - lift_offs[0][3]), period);
    if (leg % 2 == 0) {
      EXPECT_NEAR(lag, 0., 2. * dt);
    } else {
      EXPECT_NEAR(lag, period / 2., 2. * dt);
    }
  }
}

TEST_F(TripodGait, StanceFeetMoveAgainstTheBody) {
  const double v_x = 0.06, v_y = 0.03, w_z = 0.2;
  bench.set("forward", v_x);
  bench.set("sideways", v_y);
  bench.set("turn", w_z);
  bench.start(dt);
  run_until(6.);  // 19 time constants of the command's lag
  for (int k = 0; k < 1200; ++k) {
    std::array<Vector3d, legs> before;
    std::array<bool, legs> stood{};
    for (std::size_t leg = 0; leg < legs; ++leg) {
      before[leg] = bench.foot(leg);
      stood[leg] = bench.stance(leg);
    }
    bench.update();
    for (std::size_t leg = 0; leg < legs; ++leg) {
      if (!stood[leg] || !bench.stance(leg)) continue;
      const Vector3d velocity = (1. / dt) * (bench.foot(leg) - before[leg]);
      const Vector3d middle = 0.5 * (bench.foot(leg) + before[leg]);
      // -(v + w x p): the chord of an arc of w dt = 2e-4 rad differs from the arc by its square.
      EXPECT_NEAR(velocity.x, -v_x + w_z * middle.y, 1e-8);
      EXPECT_NEAR(velocity.y, -v_y - w_z * middle.x, 1e-8);
      EXPECT_NEAR(velocity.z, 0., 1e-9);
    }
  }
}

TEST_F(TripodGait, TheNeutralPositionIsTheMiddleOfTheStance) {
  bench.set("forward", 0.08);
  bench.start(dt);
  run_until(6.);
  std::array<double, legs> front{}, rear{};
  front.fill(-1.);
  rear.fill(1.);
  for (int k = 0; k < 1200; ++k) {
    bench.update();
    for (std::size_t leg = 0; leg < legs; ++leg) {
      if (!bench.stance(leg)) continue;
      const double x = bench.foot(leg).x - bench.neutral(leg).x;
      front[leg] = std::max(front[leg], x);
      rear[leg] = std::min(rear[leg], x);
    }
  }
  // Half a stride each way: v duty period / 2, sampled each dt.
  const double half = 0.5 * 0.08 * duty * period;
  for (std::size_t leg = 0; leg < legs; ++leg) {
    EXPECT_NEAR(front[leg], half, 0.08 * dt + 1e-9);
    EXPECT_NEAR(rear[leg], -half, 0.08 * dt + 1e-9);
  }
}

TEST_F(TripodGait, FeetMoveWithoutJumps) {
  bench.set("forward", 0.1);
  bench.start(dt);
  std::array<Vector3d, legs> before, rate;
  double fastest = 0., hardest = 0., highest = -1.;
  for (std::size_t leg = 0; leg < legs; ++leg) before[leg] = bench.foot(leg);
  for (int k = 0; k < 6000; ++k) {
    // The commands jump too.
    if (k == 3000) bench.set("forward", -0.05);
    if (k == 4000) bench.set("turn", 0.4);
    bench.update();
    for (std::size_t leg = 0; leg < legs; ++leg) {
      const Vector3d velocity = (1. / dt) * (bench.foot(leg) - before[leg]);
      fastest = std::max(fastest, norm(velocity));
      // While the command changes the target of a swing does: its velocity is bounded then, its
      // acceleration is not.
      if (k > 2500 && k < 3000) hardest = std::max(hardest, norm(velocity - rate[leg]) / dt);
      rate[leg] = velocity;
      before[leg] = bench.foot(leg);
      highest = std::max(highest, before[leg].z);
    }
  }
  // The swing of T = 0.24 s: horizontally the cubic's peak (3/2)(v period)/T relative to the
  // ground; up 64 h 3 (s - s^2)^2 (1 - 2 s)/T with its greatest value 3.4346 h/T at s = (1 - 1/sqrt
  // 5)/2. The commanded change adds less than its own size over the lag.
  const double swing = (1. - duty) * period;
  const double bound = std::hypot(1.5 * 0.1 * period / swing + 0.15, 3.4346 * 0.03 / swing);
  EXPECT_LT(fastest, bound);
  EXPECT_GT(fastest, 0.5 * bound);
  // Of the path itself: up 64 h (6 u - 30 u^2)/T^2 with u = s (1 - s), 24 h/T^2 at the top;
  // horizontally 6 v period/T^2 at the ends.
  EXPECT_LT(hardest, std::hypot(24. * 0.03, 6. * 0.1 * period) / (swing * swing));
  EXPECT_NEAR(highest, -0.1 + 0.03, 1e-5);
}

TEST_F(TripodGait, StartsFromTheNeutralPosture) {
  bench.set("forward", 0.1);
  bench.start(dt);
  for (std::size_t leg = 0; leg < legs; ++leg) {
    EXPECT_NEAR(bench.get("goal", 3 * leg + 1), std::numbers::pi / 6., 1e-12);
    EXPECT_NEAR(bench.get("goal", 3 * leg + 2), -2. * std::numbers::pi / 3., 1e-12);
  }
  const double before = bench.get("goal", 1);
  run_until(stand);
  EXPECT_EQ(bench.get("goal", 1), before);
  run_until(stand + 0.1);
  EXPECT_NE(bench.get("goal", 1), before);
}

TEST_F(TripodGait, FollowsTheCommandWithItsLag) {
  bench.set("forward", 0.1);
  bench.set("command_lag", 0.2);
  bench.start(dt);
  run_until(stand + 0.2);
  const double before = bench.foot(1).x;
  bench.update();
  ASSERT_TRUE(bench.stance(1));
  EXPECT_NEAR((bench.foot(1).x - before) / dt, -0.1 * (1. - std::exp(-1.)), 1e-8);
}

TEST_F(TripodGait, HeightOffsetsLengthenTheLegs) {
  bench.set("height_offset", 4, 0.012);
  bench.start(dt);
  bench.update();
  EXPECT_NEAR(bench.foot(4).z, -0.112, 1e-12);
  EXPECT_NEAR(bench.foot(3).z, -0.1, 1e-12);
}

TEST_F(TripodGait, AnEarlyContactEndsTheSwingAndAMissingOneIsSearched) {
  bench.drive("contact", 0);
  bench.set("contact", 0, 1.);
  bench.start(dt);
  run_until(stand + 0.1);
  EXPECT_FALSE(
      bench.stance(0));  // contact of the lift-off, before the middle of the swing of 0.24 s
  run_until(stand + 0.15);
  EXPECT_TRUE(bench.stance(0));
  EXPECT_FALSE(bench.stance(2));
  EXPECT_GT(bench.foot(0).z,
            -0.085);  // where it met the ground, not pushed down to the nominal height
  bench.set("contact", 0, 0.);
  run_until(stand + 0.55);
  EXPECT_NEAR(bench.foot(0).z, -0.12, 1e-12);  // search_depth below
  EXPECT_NEAR(bench.foot(4).z, -0.1, 1e-12);
}

TEST_F(TripodGait, FeetOutOfReachAreRefusedAndCounted) {
  bench.set("body_height", 0.3);
  EXPECT_THROW(bench.start(dt), std::runtime_error);
  bench.set("body_height", 0.1);
  bench.start(dt);
  bench.update();
  EXPECT_EQ(bench.get("unreachable"), 0.);
  bench.set("height_offset", 2, 0.2);
  bench.update();
  EXPECT_EQ(bench.get("unreachable"), 1.);
}

TEST_F(TripodGait, AnyScheduleGivesTheSameClock) {
  bench.set("forward", 0.08);
  HexapodGaitBench slow{"Controller.TripodGait"};
  for (const char* name : {"period", "duty_factor", "stand", "forward"})
    slow.set(name, bench.get(name));
  bench.start(dt);
  slow.start(0.02);
  run_until(3.001);
  while (slow.time() < 3.01) slow.update();
  for (std::size_t leg = 0; leg < legs; ++leg)
    EXPECT_NEAR(slow.get("phase", leg), bench.get("phase", leg), 1e-9);
}

TEST_F(TripodGait, ResumesFromItsValues) {
  bench.set("forward", 0.08);
  bench.start(dt);
  run_until(1.234);
  EXPECT_TRUE(resumes_from_its_values(bench, "Controller.TripodGait", dt));
}

TEST_F(TripodGait, UpdatesAllocateNothing) {
  bench.set("forward", 0.08);
  bench.start(dt);
  control::Component& gait = bench.component();
  const long before = allocation_count();
  for (std::int64_t k = 0; k < 2000; ++k) gait.update({double(k) * dt, dt, k});
  EXPECT_EQ(allocation_count(), before);
}

}  // namespace
}  // namespace hookpoint::testing
