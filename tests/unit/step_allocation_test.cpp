// A step allocates nothing: counted at operator new, for every law and integrator of ours.
#include <gtest/gtest.h>

#include <atomic>
#include <cstdlib>
#include <new>

#include "simulation/dts_engine.h"
#include "tests/support/scene.h"

namespace {
std::atomic<long> allocations = 0;
}

void* operator new(std::size_t size) {
  ++allocations;
  if (void* memory = std::malloc(size)) return memory;
  throw std::bad_alloc();
}
void operator delete(void* memory) noexcept { std::free(memory); }
void operator delete(void* memory, std::size_t) noexcept { std::free(memory); }

namespace hookpoint {
namespace {

long allocations_in_steps(const simulation::Experiment& experiment, int steps) {
  const auto engine = simulation::make_dts(experiment);
  EXPECT_TRUE(engine->step().ok());
  const long before = allocations;
  for (int i = 0; i < steps; ++i) EXPECT_TRUE(engine->step().ok());
  return allocations - before;
}

TEST(StepAllocation, CounterCounts) {
  const long before = allocations;
  std::vector<double> numbers(100);
  EXPECT_EQ(allocations - before, 1);
  EXPECT_EQ(numbers.size(), 100u);
}

TEST(StepAllocation, BlockUnderEveryLaw) {
  for (const char* law :
       {"hookpoint", "hookpoint_reset", "hunt_crossley", "impulse", "impulse_reversal"}) {
    const auto experiment =
        testing::load_scene("scenes/sloped_block.hook", {{"slope", "15 deg"}, {"dt", "0.1 ms"}},
                            {{"world.contact", law}});
    EXPECT_EQ(allocations_in_steps(experiment, 200), 0) << law;
  }
}

TEST(StepAllocation, HexapodUnderEveryIntegrator) {
  for (const char* integrator : {"explicit_euler", "semi_implicit_euler", "rk4"}) {
    simulation::Experiment experiment = testing::load_scene("scenes/standing_hexapod.hook", {});
    experiment.integrator = integrator;
    experiment.deltat = 1e-4;
    EXPECT_EQ(allocations_in_steps(experiment, 100), 0) << integrator;
  }
}

}  // namespace
}  // namespace hookpoint
