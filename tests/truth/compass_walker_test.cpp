// The compass walker: its return map on rigid ground, which reproduces the limit cycle that is
// published for the simplest one, and the engine's walkers on compliant ground, which come to the
// map's cycle and to the published one as the ground gets stiffer.
#include "tests/support/compass_walker.h"

#include <gtest/gtest.h>

#include <numbers>
#include <string>

#include "simulation/dts_engine/dts_engine.h"
#include "tests/support/scene.h"

namespace hookpoint {
namespace {

using namespace test_support;
using simulation::Experiment;

constexpr double g = 9.81;

// Garcia, Chatterjee, Ruina & Coleman 1998, slope 0.009 rad, feet without mass, g = l = 1: angle of
// the stance leg from the slope's normal after the collision, its rate, and the return map's
// multipliers, as in the authors' program for the paper.
constexpr double published_angle = 0.20031090049483, published_rate = 0.19983247291764;
constexpr double published_multiplier_real = -0.1912, published_multiplier_imaginary = 0.5563;

CompassWalker simplest_walker(double foot_mass) { return {1., foot_mass, 1., 1., 0.009, 1.}; }

CompassState published_start() {
  return {0.009 - published_angle, 0.009 + published_angle, published_rate,
          published_rate * std::cos(2. * published_angle)};
}

/// Its limit without mass from two small masses.
template <class Quantity>
double without_mass(const Quantity& quantity) {
  constexpr double mass = 1e-5;
  return 2. * quantity(simplest_walker(mass)) - quantity(simplest_walker(2. * mass));
}

TEST(RigidCompassWalker, HasThePublishedLimitCycle) {
  const auto cycle = [](const CompassWalker& w) {
    return limit_cycle(w, published_start(), 2e-3, 60);
  };
  const auto angle = [&](const CompassWalker& w) { return w.slope - cycle(w).next.stance; };
  const auto rate = [&](const CompassWalker& w) { return cycle(w).next.stance_rate; };
  EXPECT_NEAR(without_mass(angle), published_angle, 1e-8);
  EXPECT_NEAR(without_mass(rate), published_rate, 1e-8);
}

// Of the three numbers that a step starts from (angle and two rates) one is forgotten: the map's
// eigenvalues are 0 and the published pair, within 0.003.
TEST(RigidCompassWalker, HasThePublishedMultipliers) {
  const CompassWalker w = simplest_walker(1e-6);
  const CompassState cycle = limit_cycle(w, published_start(), 2e-3, 60).next;
  const auto numbers = [](const CompassState& y) {
    return std::array{y.stance, y.stance_rate, y.swing_rate};
  };
  std::array<std::array<double, 3>, 3> jacobian{};  // [column][row]
  for (std::size_t i = 0; i < 3; ++i) {
    const auto next = [&](double by) {
      auto at = numbers(cycle);
      at[i] += by;
      return numbers(compass_step(w, {at[0], 2. * w.slope - at[0], at[1], at[2]}, 2e-3).next);
    };
    const double by = 1e-5;
    const auto more = next(by), less = next(-by);
    for (std::size_t row = 0; row < 3; ++row)
      jacobian[i][row] = (more[row] - less[row]) / (2. * by);
  }
  const auto minor = [&](std::size_t i, std::size_t j) {
    return jacobian[i][i] * jacobian[j][j] - jacobian[i][j] * jacobian[j][i];
  };
  EXPECT_NEAR(jacobian[0][0] + jacobian[1][1] + jacobian[2][2], 2. * published_multiplier_real,
              3e-3);
  EXPECT_NEAR(minor(0, 1) + minor(0, 2) + minor(1, 2),
              published_multiplier_real * published_multiplier_real +
                  published_multiplier_imaginary * published_multiplier_imaginary,
              3e-3);
}

CompassWalker goswami() { return {10., 5., 1., 0.5, 3. * std::numbers::pi / 180., g}; }

CompassStep goswami_cycle() { return limit_cycle(goswami(), {-0.22, 0.32, 1.1, 0.4}, 2e-4, 60); }

TEST(CompassWalkerScene, StartsInTheRigidLimitCycle) {
  const Experiment scene = testing::load_scene("scenes/compass_walker.hook", {});
  const CompassState start = goswami_cycle().next;
  const auto& chains = scene.robots[0].chains;
  EXPECT_NEAR(chains[0].links[0].angle, start.stance, 1e-8);
  EXPECT_NEAR(chains[1].links[0].angle, start.swing, 1e-8);
  EXPECT_NEAR(chains[0].links[0].rate, start.stance_rate, 1e-8);
  EXPECT_NEAR(chains[1].links[0].rate, start.swing_rate, 1e-8);
}

/// How the engine's walker lands, mean of steps `from` to `to`.
struct Gait {
  double swing = 0.;   ///< angle of the landing leg [rad]
  double period = 0.;  ///< [s]
};

/// The legs change roles at each landing, whose instant lies on a straight line between two steps.
Gait walk(const CompassWalker& w, const Experiment& scene, int from, int to) {
  const auto engine = simulation::make_dts(scene);
  std::size_t stance = 0;
  const auto legs = [&] {
    const auto& joints = engine->state().joints;
    return CompassState{joints[stance].angle, joints[1 - stance].angle, 0., 0.};
  };
  Gait gait;
  double first = 0.;
  for (int landings = 0; landings < to;) {
    const CompassState before = legs();
    if (!engine->step().ok() || engine->state().time > 30.)
      throw std::runtime_error("the walker fell after " + std::to_string(landings) + " steps");
    const CompassState after = legs();
    if (!lands(w, before, after)) continue;
    const double high = swing_clearance(w, before), low = swing_clearance(w, after);
    const double part = high / (high - low);
    const double time = engine->state().time - (1. - part) * scene.deltat;
    if (++landings == from) first = time;
    if (landings > from) gait.swing += before.swing + part * (after.swing - before.swing);
    if (landings == to) gait.period = (time - first) / (to - from);
    stance = 1 - stance;
  }
  gait.swing /= to - from;
  return gait;
}

TEST(CompassWalkerScene, ComesToTheRigidCycleAsTheGroundGetsStiffer) {
  const CompassStep rigid = goswami_cycle();
  const auto walks_on = [](const std::string& stiffness, const std::string& dt) {
    return walk(
        goswami(),
        testing::load_scene("scenes/compass_walker.hook", {{"stiffness", stiffness}, {"dt", dt}}),
        6, 12);
  };
  const Gait soft = walks_on("300 kN/m", "0.02 ms"), stiff = walks_on("3000 kN/m", "0.01 ms");
  const auto period_error = [&](const Gait& gait) {
    return std::abs(gait.period / rigid.period - 1.);
  };
  const auto angle_error = [&](const Gait& gait) {
    return std::abs(gait.swing / rigid.landed.swing - 1.);
  };
  // A blow takes a time like sqrt(m/k).
  EXPECT_LE(period_error(stiff), 0.5 * period_error(soft));
  EXPECT_LE(period_error(stiff), 1e-3);
  EXPECT_LE(angle_error(stiff), 0.3 * angle_error(soft));
  EXPECT_LE(angle_error(stiff), 1e-3);
}

/// The scene with the numbers of the simplest walker, feet of a thousandth of the hip's mass.
Experiment simplest_walker_scene(const std::string& stiffness) {
  const double pace = std::sqrt(g);
  const CompassState start = published_start();
  Experiment scene = testing::load_scene("scenes/compass_walker.hook",
                                         {{"slope", "0.009 rad"},
                                          {"hip_mass", "1 kg"},
                                          {"leg_mass", "0.001 kg"},
                                          {"com", "1 m"},
                                          {"stiffness", stiffness},
                                          {"dt", "2 ms"},
                                          {"stance_angle", std::to_string(start.stance)},
                                          {"stance_rate", std::to_string(pace * start.stance_rate)},
                                          {"swing_rate", std::to_string(pace * start.swing_rate)}});
  scene.integrator = "cvode_bdf";
  scene.relative_tolerance = 1e-7;
  scene.absolute_tolerance = 1e-9;
  return scene;
}

TEST(CompassWalkerScene, WalksAsThePublishedSimplestWalker) {
  CompassWalker w = simplest_walker(1e-3);
  w.gravity = g;
  const double period =
      limit_cycle(w, {published_start().stance, published_start().swing, 0.6259, 0.5764}, 1e-3, 40)
          .period;
  const Gait gait = walk(w, simplest_walker_scene("10 MN/m"), 6, 12);
  EXPECT_NEAR(w.slope - gait.swing, published_angle, 0.002 * published_angle);
  EXPECT_NEAR(gait.period, period, 0.0005 * period);
}

}  // namespace
}  // namespace hookpoint
