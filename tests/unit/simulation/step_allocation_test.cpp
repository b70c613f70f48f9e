// A step allocates nothing: counted at operator new, for every law and integrator of ours.
#include <gtest/gtest.h>

#include "simulation/dts_engine/dts_engine.h"
#include "tests/support/allocation_counter.h"
#include "tests/support/load_text.h"
#include "tests/support/scene.h"

namespace hookpoint {
namespace {

long allocations_in_steps(const simulation::Experiment& experiment, int steps) {
  const auto engine = simulation::make_dts(experiment);
  engine->publish_ground_forces();
  EXPECT_TRUE(engine->step().ok());
  const long before = testing::allocation_count();
  for (int i = 0; i < steps; ++i) EXPECT_TRUE(engine->step().ok());
  return testing::allocation_count() - before;
}

TEST(StepAllocation, CounterCounts) {
  const long before = testing::allocation_count();
  std::vector<double> numbers(100);
  EXPECT_EQ(testing::allocation_count() - before, 1);
  EXPECT_EQ(numbers.size(), 100u);
}

TEST(StepAllocation, BlockUnderEveryLaw) {
  for (const char* law :
       {"hookpoint", "hookpoint_reset", "nominal", "hunt_crossley", "azad_featherstone", "lugre",
        "elastoplastic", "exponential", "impulse", "impulse_reversal"}) {
    const auto experiment =
        testing::load_scene("scenes/sloped_block.hook", {{"slope", "15 deg"}, {"dt", "0.1 ms"}},
                            {{"world.contact", law}});
    EXPECT_EQ(allocations_in_steps(experiment, 200), 0) << law;
  }
}

TEST(StepAllocation, ChainsOnLinks) {
  simulation::Experiment experiment = testing::load_scene("scenes/tumbling_acrobat.hook", {});
  EXPECT_EQ(allocations_in_steps(experiment, 100), 0);
  experiment.contact = "impulse";
  EXPECT_EQ(allocations_in_steps(experiment, 100), 0);
}

TEST(StepAllocation, HexapodUnderTheImpulseLaws) {
  for (const char* law : {"impulse", "impulse_reversal"}) {
    simulation::Experiment experiment =
        testing::load_scene("scenes/standing_hexapod.hook", {}, {{"world.contact", law}});
    for (simulation::MaterialSpec& material : experiment.materials)
      material.constants.rebound_speed = 1e-2;
    EXPECT_EQ(allocations_in_steps(experiment, 100), 0) << law;
  }
}

TEST(StepAllocation, BodiesThatTouchUnderTheImpulseLaws) {
  for (const char* law : {"impulse", "impulse_reversal"}) {
    const Loaded pile = load_text(
        std::string("World w { gravity = 9.81; deltat = 1 ms; contact = ") + law +
        "; Material m { rebound_speed = 2 mm/s; } Terrain.Flat ground { velocity = 0.1, 0, 0; "
        "material = m; } For i in 0..3 { Robot box[i] { Base.mobile { location = 0.02 * i, 0.01 * i, "
        "0.051 + 0.102 * i; Shape.Box { dimensions = 0.1, 0.1, 0.1; mass = 1; } } } } }");
    ASSERT_TRUE(pile.experiment) << pile.diagnostics;
    EXPECT_EQ(allocations_in_steps(*pile.experiment, 50), 0) << law;
  }
}

TEST(StepAllocation, HexapodUnderEveryIntegrator) {
  for (const char* integrator : {"explicit_euler", "semi_implicit_euler", "implicit_joints", "rk4",
                                 "cvode_bdf", "cvode_adams", "arkode", "arkode_imex"}) {
    simulation::Experiment experiment = testing::load_scene("scenes/standing_hexapod.hook", {});
    experiment.integrator = integrator;
    experiment.deltat = 1e-4;
    EXPECT_EQ(allocations_in_steps(experiment, 100), 0) << integrator;
  }
}

}  // namespace
}  // namespace hookpoint
