// The force laws in the engine: on a point, on a block, and under the legs of a robot, with their
// bristles integrated beside the motion.
#include <gtest/gtest.h>

#include <cmath>
#include <numbers>

#include "contact/force_law.h"
#include "simulation/analysis/stability.h"
#include "simulation/dts_engine/dts_engine.h"
#include "tests/support/scene.h"

namespace hookpoint {
namespace {

constexpr double g = 9.81;
constexpr double degree = std::numbers::pi / 180.;

const std::vector<std::string> holding_laws{"hookpoint",     "nominal",     "azad_featherstone",
                                            "elastoplastic", "exponential", "lugre"};
const std::vector<std::string> bristle_laws{"azad_featherstone", "elastoplastic", "exponential",
                                            "lugre"};

simulation::Experiment shaken_point(const std::string& law, const std::string& integrator,
                                    std::map<std::string, std::string> parameters) {
  return testing::load_scene("scenes/vibrating_slope.hook", parameters,
                             {{"world.contact", law}, {"world.integrator", integrator}});
}

/// How far a point left to itself comes down the slope.
double downhill_after(const simulation::Experiment& experiment, double seconds) {
  const auto engine = simulation::make_dts(experiment);
  const Vector3d start = engine->state().bodies[0].position;
  for (long i = std::lround(seconds / experiment.deltat); i > 0; --i) {
    if (!engine->step().ok()) return std::nan("");
  }
  return dot(engine->state().bodies[0].position - start,
             {std::cos(20. * degree), 0., -std::sin(20. * degree)});
}

// Weakly damped, and let go at once where even twice the load is within the cone. A bristle that
// the integrator moved with the old velocity would take in energy and swing up.
TEST(LawsInTheEngine, APointComesToRestOnItsBristle) {
  const double load = g * std::sin(20. * degree);
  for (const std::string& law : bristle_laws) {
    if (law == "lugre") continue;  // it slips a little as it swings
    for (const char* integrator : {"semi_implicit_euler", "rk4"}) {
      const auto experiment = shaken_point(
          law, integrator, {{"mu", "1.2"}, {"stiffness", "200 kN/m"}, {"dt", "0.5 ms"}});
      EXPECT_GT(simulation::stability_bound(experiment).step, experiment.deltat);
      const double shift = load / 2e5;
      EXPECT_NEAR(downhill_after(experiment, 3.), shift, 1e-6 * shift) << law << " " << integrator;
    }
  }
}

// RK4 against itself with a much finer step, while everything is smooth: a bristle is integrated to
// the integrator's order.
TEST(LawsInTheEngine, BristlesAreIntegratedToTheIntegratorsOrder) {
  for (const char* law : {"azad_featherstone", "exponential"}) {
    const auto at = [&](const std::string& dt) {
      return downhill_after(shaken_point(law, "rk4", {{"mu", "1.2"}, {"dt", dt}}), 0.02);
    };
    const double truth = at("0.02 ms");
    const double coarse = std::abs(at("2 ms") - truth), fine = std::abs(at("1 ms") - truth);
    EXPECT_NEAR(std::log2(coarse / fine), 4., 0.5) << law;
  }
}

TEST(LawsInTheEngine, EveryIntegratorComesToTheSameRest) {
  for (const std::string& law : bristle_laws) {
    const auto rest = [&](const char* integrator) {
      return downhill_after(
          shaken_point(law, integrator, {{"mu", "1.2"}, {"tangential_ratio", "0.5"}}), 0.5);
    };
    const double expected = rest("rk4");
    EXPECT_GT(expected, 1e-4);
    for (const char* integrator : {"explicit_euler", "semi_implicit_euler", "cvode_bdf", "arkode"})
      EXPECT_NEAR(rest(integrator), expected, 1e-2 * expected) << law << " " << integrator;
  }
}

TEST(LawsInTheEngine, AHexapodStandsUnderEveryOne) {
  for (const std::string& law : holding_laws) {
    const auto experiment =
        testing::load_scene("scenes/standing_hexapod.hook", {}, {{"world.contact", law}});
    const auto engine = simulation::make_dts(experiment);
    for (int i = 0; i < 8000; ++i) ASSERT_TRUE(engine->step().ok()) << law;
    double mass = 0.;
    const simulation::RobotSpec& robot = experiment.robots[0];
    mass += robot.base.mass.mass;
    for (const auto& chain : robot.chains)
      for (const auto& link : chain.links) mass += link.body.mass.mass;
    Vector3d ground_force;
    for (const auto& body : engine->state().bodies) ground_force += body.contact_force;
    EXPECT_NEAR(ground_force.z, mass * g, 2e-3 * mass * g) << law;
    EXPECT_NEAR(ground_force.x, 0., 1e-6) << law;
    const simulation::BodyState& base = engine->state().bodies[0];
    EXPECT_LE(std::hypot(base.position.x, base.position.y), 1e-9) << law;  // symmetric
    EXPECT_GT(base.position.z, 0.085) << law;
  }
}

}  // namespace
}  // namespace hookpoint
