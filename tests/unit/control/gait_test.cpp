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

/// Four mammals' legs on the bench, knees backwards, each foot below the end of its hip's offset.
ComponentBench four_legs(const std::string& pattern) {
  ComponentBench bench("Controller.Gait", 1e-3);
  bench["legs"] = 4.;
  bench.text("leg", "mammal");
  bench.text("pattern", pattern);
  for (std::size_t leg = 0; leg < 4; ++leg) {
    const std::string i = "[" + std::to_string(leg) + "]";
    const double side = leg < 2 ? -1. : 1., x = leg % 2 == 0 ? -0.2 : 0.2;
    bench["hip_x" + i] = bench["foot_x" + i] = x;
    bench["hip_y" + i] = 0.05 * side;
    bench["hip_offset" + i] = 0.08 * side;
    bench["foot_y" + i] = 0.13 * side;
    bench["femur_length" + i] = bench["tibia_length" + i] = 0.2;
    bench["knee_forward" + i] = 0.;
  }
  bench["body_height"] = 0.28;
  bench["forward"] = 0.1;
  bench["period"] = 0.8;
  bench["stand"] = 0.;
  return bench;
}

TEST(Gait, OfFourLegsTouchesDownInTheOrderOfItsName) {
  // Lags after the left hind foot: of the right hind, right fore and left fore one.
  struct Order {
    const char* pattern;
    double right_hind, right_fore, left_fore;
  };
  // Walk: left hind, left fore, right hind, right fore (Hildebrand's lateral sequence).
  for (const Order& order :
       {Order{"walk", 0.5, 0.75, 0.25}, Order{"trot", 0.5, 0., 0.5}, Order{"pace", 0.5, 0.5, 0.},
        Order{"bound", 0., 0.5, 0.5}, Order{"gallop", 0.1, 0.6, 0.5}}) {
    ComponentBench bench = four_legs(order.pattern);
    bench["duty_factor"] = 0.5;
    bench.start();
    std::vector<double> landed(4), before(4, 1.);
    for (int k = 0; k < 4000; ++k) {
      bench.tick();
      for (std::size_t leg = 0; leg < 4; ++leg) {
        const double now = bench["stance[" + std::to_string(leg) + "]"];
        if (now > before[leg]) landed[leg] = 1e-3 * k;
        before[leg] = now;
      }
    }
    const auto lag = [&](std::size_t leg) {
      const double periods = (landed[leg] - landed[2]) / 0.8 + 4.;
      return periods - std::floor(periods + 1e-2);
    };
    EXPECT_NEAR(lag(0), order.right_hind, 2.1e-3 / 0.8) << order.pattern;
    EXPECT_NEAR(lag(1), order.right_fore, 2.1e-3 / 0.8) << order.pattern;
    EXPECT_NEAR(lag(3), order.left_fore, 2.1e-3 / 0.8) << order.pattern;
  }
}

TEST(Gait, RefusesAPatternOfFourLegsForOthers) {
  ComponentBench bench = eight_legs(1e-3);
  bench.text("pattern", "trot");
  EXPECT_EQ(testing::start_error(bench), "the pattern `trot` is of four legs: write legs = 4");
}

/// A mammal's foot relative to the body, from the gait's goals.
Vector3d foot_of(ComponentBench& bench, std::size_t leg) {
  const auto value = [&](const char* name) {
    return bench[std::string(name) + "[" + std::to_string(leg) + "]"];
  };
  const auto goal = [&](std::size_t joint) {
    return bench["goal[" + std::to_string(3 * leg + joint) + "]"];
  };
  const control::Leg of{control::LegKind::mammal,
                        {0., value("femur_length"), value("tibia_length")},
                        value("hip_offset"),
                        control::Knee::up};
  const Vector3d p_HF = control::foot_position(of, {goal(0), goal(1), goal(2)});
  return {value("hip_x") + p_HF.z, value("hip_y") + p_HF.y, -p_HF.x};
}

TEST(Gait, OfMammalsPutsFeetWhereTheyStandAndCarriesThem) {
  ComponentBench bench = four_legs("trot");
  bench["duty_factor"] = 0.5;
  bench["command_lag"] = 0.;
  bench.start();
  bench.tick();
  for (std::size_t leg = 0; leg < 4; ++leg) {
    const Vector3d stands{leg % 2 == 0 ? -0.2 : 0.2, leg < 2 ? -0.13 : 0.13, -0.28};
    EXPECT_LT(norm(foot_of(bench, leg) - stands), 1e-12) << leg;
    EXPECT_LE(bench["goal[" + std::to_string(3 * leg + 2) + "]"], 0.) << leg;  // knee backwards
  }
  // From stance to stance of a period each: half a stance before and behind its neutral position.
  bench.tick(8000);
  Vector3d least{1., 1., 1.}, greatest{-1., -1., -1.};
  for (int k = 0; k < 800; ++k) {
    bench.tick();
    const Vector3d foot = foot_of(bench, 3);
    EXPECT_NEAR(foot.y, 0.13, 1e-12);
    if (bench["stance[3]"] == 0.) continue;
    EXPECT_NEAR(foot.z, -0.28, 1e-12);
    least.x = std::min(least.x, foot.x);
    greatest.x = std::max(greatest.x, foot.x);
  }
  EXPECT_NEAR(greatest.x, 0.2 + 0.5 * 0.5 * 0.8 * 0.1, 2e-4);
  EXPECT_NEAR(least.x, 0.2 - 0.5 * 0.5 * 0.8 * 0.1, 2e-4);
}

TEST(Gait, AddsThePlacementToWhereASwingEnds) {
  ComponentBench bench = four_legs("trot");
  bench["duty_factor"] = 0.5;
  bench["forward"] = 0.;
  for (const char* leg : {"[0]", "[1]", "[2]", "[3]"}) {
    bench.drive(std::string("placement_x") + leg, 0.03);
    bench.drive(std::string("placement_y") + leg, -0.02);
  }
  bench.start();
  bench.tick(4000);
  for (std::size_t leg = 0; leg < 4; ++leg) {
    const Vector3d foot = foot_of(bench, leg);
    if (bench["stance[" + std::to_string(leg) + "]"] == 0.) continue;
    EXPECT_NEAR(foot.x, (leg % 2 == 0 ? -0.2 : 0.2) + 0.03, 1e-12) << leg;
    EXPECT_NEAR(foot.y, (leg < 2 ? -0.13 : 0.13) - 0.02, 1e-12) << leg;
  }
}

TEST(Gait, LiftsAFootBeforeItGoesForwards) {
  // A fifth of a swing of 0.4 s up over where it stood, in the ground's motion, and a fifth down
  // over where it lands; half of the rise is done by then: 10 r^3 - 15 r^4 + 6 r^5 = 1/2 at r = 1/2.
  ComponentBench bench = four_legs("trot");
  bench["duty_factor"] = 0.5;
  bench["step_height"] = 0.1;
  bench["swing_lift"] = 0.2;
  bench["command_lag"] = 0.;
  bench.start();
  bench.tick(8100);  // in stance
  ASSERT_EQ(bench["stance[3]"], 1.);
  bool seen = false;
  double lifted_x = 0., ticks = 0.;
  for (int k = 0; k < 1600; ++k) {
    const bool stood = bench["stance[3]"] == 1.;
    const double before = foot_of(bench, 3).x;
    bench.tick();
    if (bench["stance[3]"] == 1.) {
      ticks = 0.;
      continue;
    }
    if (stood) lifted_x = before;
    ++ticks;
    const Vector3d foot = foot_of(bench, 3);
    if (ticks <= 79.) {
      EXPECT_NEAR(foot.x, lifted_x - 0.1 * 1e-3 * ticks, 1.1e-4);
    }
    if (ticks == 80.) {
      EXPECT_NEAR(foot.z + 0.28, 0.05, 1.5e-3);
      seen = true;
    }
    if (ticks > 160. && ticks < 240.) {
      EXPECT_NEAR(foot.z + 0.28, 0.1, 1e-9);
    }
  }
  EXPECT_TRUE(seen);
}

/// A point of the body passes over its foot as Raibert's neutral point has it.
TEST(FootPlacement, IsHalfAStanceAndAGainOfTheErrorOfSpeed) {
  ComponentBench bench("Controller.FootPlacement", 1e-3);
  bench["forward"] = 0.5;
  bench["stance_time"] = 0.2;
  bench["speed_gain"] = 0.05;
  bench["foot_x[1]"] = 0.2;
  bench["foot_y[1]"] = -0.1;
  bench["turn"] = 0.1;
  // Yawed by 30 deg, 0.7 m/s along its heading and 0.1 m/s to the left, turning at 0.4 rad/s.
  const double yaw = std::numbers::pi / 6.;
  bench["orientation[0]"] = std::cos(yaw / 2.);
  bench["orientation[3]"] = std::sin(yaw / 2.);
  bench["velocity[0]"] = 0.7 * std::cos(yaw) - 0.1 * std::sin(yaw);
  bench["velocity[1]"] = 0.7 * std::sin(yaw) + 0.1 * std::cos(yaw);
  bench["angular_velocity[2]"] = 0.4;
  bench.start();
  bench.tick();
  EXPECT_NEAR(bench["speed[0]"], 0.7, 1e-15);
  EXPECT_NEAR(bench["speed[1]"], 0.1, 1e-15);
  EXPECT_NEAR(bench["placement_x[0]"], 0.15 * 0.2, 1e-15);
  EXPECT_NEAR(bench["placement_y[0]"], 0.15 * 0.1, 1e-15);
  // The velocity of the body over leg 1: omega x p = 0.3 (0.1, 0.2).
  EXPECT_NEAR(bench["placement_x[1]"], 0.15 * (0.2 + 0.03), 1e-15);
  EXPECT_NEAR(bench["placement_y[1]"], 0.15 * (0.1 + 0.06), 1e-15);
}

TEST(FootPlacement, StandsOnThePlumbLineOfABodyThatLeans) {
  ComponentBench bench("Controller.FootPlacement", 1e-3);
  bench["body_height"] = 0.3;
  // Its front is down by 0.1 rad: below the hip in the body's axes is 0.3 tan 0.1 behind the plumb
  // line.
  bench["orientation[0]"] = std::cos(0.05);
  bench["orientation[2]"] = std::sin(0.05);
  bench.start();
  bench.tick();
  EXPECT_NEAR(bench["placement_x[0]"], 0.3 * std::tan(0.1), 1e-15);
  EXPECT_NEAR(bench["placement_y[0]"], 0., 1e-15);
  bench["plumb"] = 0.;
  bench.tick();
  EXPECT_EQ(bench["placement_x[0]"], 0.);
  // At most `largest`.
  bench["largest"] = 0.02;
  bench["velocity[1]"] = -9.;
  bench.tick();
  EXPECT_EQ(bench["placement_y[0]"], -0.02);
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

TEST(Foot, OfAMammalReachesItsTarget) {
  std::mt19937 random(5);
  std::uniform_real_distribution<double> unit(-1., 1.);
  for (const double back : {0., 1.}) {
    ComponentBench foot("Controller.Foot");
    foot.text("leg", "mammal");
    foot["hip_offset"] = 0.08;
    foot["knee_up"] = back;
    foot.start();
    for (int i = 0; i < 2000; ++i) {
      // Down from the end of the offset, turned about the hip's axis.
      const double hip = 1.5 * unit(random), along = 0.1 * unit(random);
      const double down = 0.16 + 0.02 * unit(random);
      const Vector3d target{down * std::cos(hip) - 0.08 * std::sin(hip),
                            down * std::sin(hip) + 0.08 * std::cos(hip), along};
      for (std::size_t axis = 0; axis < 3; ++axis)
        foot["target[" + std::to_string(axis) + "]"] = axis == 0   ? target.x
                                                       : axis == 1 ? target.y
                                                                   : target.z;
      foot.tick();
      EXPECT_NEAR(foot["miss"], 0., 1e-12);
      EXPECT_NEAR(foot["angle[0]"], hip, 1e-12);
      EXPECT_EQ(foot["angle[2]"] <= 0., back == 1.);
    }
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
