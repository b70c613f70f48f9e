// Controller.Gait and Controller.Foot: against the tripod gait, against the table, and against
// forward kinematics.
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <numbers>
#include <random>
#include <vector>

#include "control/leg_kinematics.h"
#include "tests/support/component_bench.h"
#include "tests/support/hexapod_gait_bench.h"

namespace hookpoint {
namespace {

using testing::ComponentBench;
using testing::HexapodGaitBench;

TEST(Gait, OfSixAlternatingLegsIsTheTripodGait) {
  HexapodGaitBench tripod{"Controller.TripodGait"}, gait{"Controller.Gait"};
  for (HexapodGaitBench* bench : {&tripod, &gait}) {
    bench->set("forward", 0.1);
    bench->set("turn", 0.2);
    bench->set("duty_factor", 0.6);
    bench->start(2e-3);
  }
  for (int k = 0; k < 2000; ++k) {
    tripod.update();
    gait.update();
    for (std::size_t i = 0; i < 18; ++i)
      ASSERT_EQ(tripod.get("goal", i), gait.get("goal", i)) << k << " " << i;
  }
}

/// Eight legs on the bench, hips in two rows, feet 0.1 m outwards.
ComponentBench eight_legs(double period) {
  ComponentBench bench("Controller.Gait", period);
  bench["legs"] = 8.;
  for (std::size_t leg = 0; leg < 8; ++leg) {
    const std::string i = "[" + std::to_string(leg) + "]";
    const double side = leg < 4 ? -1. : 1., x = 0.1 * static_cast<double>(leg % 4);
    bench["hip_x" + i] = bench["foot_x" + i] = x;
    bench["hip_y" + i] = 0.1 * side;
    bench["foot_y" + i] = 0.23 * side;
    bench["hip_heading" + i] = side * std::numbers::pi / 2.;
  }
  bench["forward"] = 0.08;
  bench["period"] = 0.8;
  bench["stand"] = 0.;
  return bench;
}

/// The last time each leg touched down before `ticks`, and the part of the last ten periods in
/// stance.
struct Footfall {
  std::vector<double> landed, stance;
};
Footfall walk(ComponentBench& bench, double period, int ticks) {
  Footfall fall{std::vector<double>(8), std::vector<double>(8)};
  std::vector<double> before(8, 1.);
  for (int k = 0; k < ticks; ++k) {
    bench.tick();
    for (std::size_t leg = 0; leg < 8; ++leg) {
      const double now = bench["stance[" + std::to_string(leg) + "]"];
      if (now > before[leg]) fall.landed[leg] = k * period;
      if (k >= ticks - 8000) fall.stance[leg] += now / 8000.;
      before[leg] = now;
    }
  }
  return fall;
}

/// Part of a period, 0 to below 1, by which the second touches down after the first.
double lag(const Footfall& fall, std::size_t first, std::size_t second) {
  const double periods = (fall.landed[second] - fall.landed[first]) / 0.8 + 4.;
  return periods - std::floor(periods + 1e-6);
}

TEST(Gait, OfATableTouchesDownWhenItSays) {
  const std::vector<double> table{0., 0.9, 0.3, 0.45, 0.6, 0.05, 0.75, 0.2};
  ComponentBench bench = eight_legs(1e-3);
  bench.text("pattern", "table");
  bench["duty_factor"] = 0.4;
  for (std::size_t leg = 0; leg < 8; ++leg)
    bench["touch_down[" + std::to_string(leg) + "]"] = table[leg];
  bench.start();
  const Footfall fall = walk(bench, 1e-3, 12000);
  for (std::size_t leg = 0; leg < 8; ++leg) {
    EXPECT_NEAR(lag(fall, 0, leg), table[leg], 2.1e-3 / 0.8) << leg;
    EXPECT_NEAR(fall.stance[leg], 0.4, 2e-3) << leg;
  }
}

TEST(Gait, OfAWaveLiftsALegAsTheOneBehindLands) {
  ComponentBench bench = eight_legs(1e-3);
  bench.text("pattern", "wave");
  bench["duty_factor"] = 0.85;
  bench.start();
  const Footfall fall = walk(bench, 1e-3, 12000);
  for (std::size_t row = 0; row + 1 < 4; ++row) {
    // Landing after landing there is one swing between.
    EXPECT_NEAR(lag(fall, row, row + 1), 0.15, 2.1e-3 / 0.8) << row;
    EXPECT_NEAR(lag(fall, row, row + 4), 0.5, 2.1e-3 / 0.8) << row;
  }
}

TEST(Gait, RefusesAnOddNumberOfLegs) {
  ComponentBench bench = eight_legs(1e-3);
  bench["legs"] = 7.;
  EXPECT_EQ(testing::start_error(bench), "legs is no even number");
}

TEST(Foot, ReachesItsTargetOrTellsByHowMuchItMisses) {
  std::mt19937 random(4);
  std::uniform_real_distribution<double> unit(-1., 1.);
  for (const int joints : {2, 3}) {
    ComponentBench foot("Controller.Foot");
    foot["joints"] = joints;
    foot.start();
    int reached = 0;
    for (int i = 0; i < 2000; ++i) {
      const double coxa = joints == 3 ? 0.05 : 0.;
      const double yaw = joints == 3 ? 3. * unit(random) : 0.;
      const double out = 0.02 + 0.14 * (unit(random) + 1.), up = 0.28 * unit(random);
      const Vector3d target{(coxa + out) * std::cos(yaw), (coxa + out) * std::sin(yaw), up};
      foot["target[0]"] = target.x;
      foot["target[1]"] = target.y;
      foot["target[2]"] = target.z;
      foot.tick();
      // From the femur's axis it reaches from 0.05 to 0.25 m.
      const double distance = std::hypot(out, up);
      const double beyond = std::max({0., distance - 0.25, 0.05 - distance});
      EXPECT_NEAR(foot["miss"], beyond, 1e-12);
      reached += beyond == 0.;
      const double q1 = joints == 3 ? foot["angle[0]"] : 0.;
      const double q2 = foot[joints == 3 ? "angle[1]" : "angle[0]"];
      const double q3 = foot[joints == 3 ? "angle[2]" : "angle[1]"];
      const Vector3d at = control::foot_position({coxa, 0.1, 0.15}, {q1, q2, q3});
      EXPECT_NEAR(norm(at - target), beyond, 1e-12);
      EXPECT_LE(q3, 0.);  // knee up
    }
    EXPECT_GT(reached, 500);
  }
}

TEST(Foot, OfTwoJointsMissesWhatIsBesideItsPlane) {
  ComponentBench foot("Controller.Foot");
  foot["joints"] = 2.;
  foot["target[0]"] = 0.1;
  foot["target[1]"] = 0.03;
  foot["target[2]"] = -0.1;
  foot.start();
  foot.tick();
  EXPECT_NEAR(foot["miss"], 0.03, 1e-12);
}

}  // namespace
}  // namespace hookpoint
