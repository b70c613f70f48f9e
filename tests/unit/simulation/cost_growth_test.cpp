// How processor time grows with the size of an experiment, over a fourfold size: linear work grows
// four times, quadratic sixteen, cubic sixty-four. The least of several runs counts, and the limits
// are wide, so that a busy machine passes.
// ctest: full, clock
#include <fmt/format.h>
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <ctime>
#include <functional>
#include <iostream>
#include <string>

#include "simulation/analysis/dynamics_report.h"
#include "simulation/analysis/stability.h"
#include "simulation/dts_engine/dts_engine.h"
#include "simulation/run/world.h"
#include "tests/support/load_text.h"

namespace hookpoint {
namespace {

double processor_time() {
  timespec time{};
  clock_gettime(CLOCK_THREAD_CPUTIME_ID, &time);
  return static_cast<double>(time.tv_sec) + 1e-9 * static_cast<double>(time.tv_nsec);
}

double time_of(const std::function<void()>& work) {
  const double begin = processor_time();
  work();
  return processor_time() - begin;
}

/// log4 of the ratio of times at `size` and four times that. The sizes take turns, and each counts with its
/// least time: what else the machine does only adds to a time. Measuring ends with three rounds below `limit`.
double exponent(int size, const std::function<std::function<void()>(int)>& work_of, double limit) {
  const std::function<void()> small_work = work_of(size), large_work = work_of(4 * size);
  double small = HUGE_VAL, large = HUGE_VAL, exponent = HUGE_VAL;
  for (int round = 0; round < 3 || (round < 12 && exponent >= limit); ++round) {
    small = std::min(small, time_of(small_work));
    large = std::min(large, time_of(large_work));
    exponent = std::log(large / small) / std::log(4.);
  }
  std::cout << fmt::format("{:6} {:8.1f} ms, {:6} {:8.1f} ms: exponent {:.2f}\n", size, 1e3 * small,
                           4 * size, 1e3 * large, exponent);
  return exponent;
}

/// That the exponent stays below `limit`.
void expect_growth_below(double limit, int size,
                         const std::function<std::function<void()>(int)>& work_of) {
  EXPECT_LT(exponent(size, work_of, limit), limit);
}

simulation::Experiment experiment_of(const std::string& text) {
  Loaded loaded = load_text(text);
  EXPECT_TRUE(loaded.experiment) << loaded.diagnostics;
  return *loaded.experiment;
}

using TextOf = std::string (*)(int size);

std::string contact_points(int size) {
  return fmt::format(
      "World w {{ deltat = 1 ms; Terrain.Flat g {{ }} Robot r {{ Base.mobile {{ location = 0, 0, "
      "1; mass = 1; inertia = 1,1,1,0,0,0; For i in 1..{} {{ ContactPoint {{ location = i*1 mm, 0, "
      "0; }} }} }} }} }}",
      size);
}

std::string expressions(int size) {
  std::string text = "World w { deltat = 1 ms; } Expression e0 { formula = \"time\"; }";
  for (int i = 1; i < size; ++i)
    text += fmt::format(" Expression e{} {{ formula = \"e{} + 1 s\"; }}", i, i - 1);
  return text;
}

std::string chains(int size) {
  return fmt::format(
      "World w {{ deltat = 1 ms; Robot r {{ Base.mobile {{ mass = 1; inertia = 1,1,1,0,0,0; }} For "
      "i in 1..{} {{ Chain c[i] {{ Link l {{ mass = 0.1; inertia = 1e-4,1e-4,1e-4,0,0,0; }} }} }} "
      "}} }}",
      size);
}

std::string links(int size) {
  return fmt::format(
      "World w {{ deltat = 1 ms; Robot r {{ Base.fixed {{ }} Chain c {{ For i in 1..{} {{ Link "
      "l[i] {{ dhlength = 0.01; dhtwist = 0.3; mass = 0.1; inertia = 1e-4,1e-4,1e-4,0,0,0; }} }} "
      "}} "
      "}} }}",
      size);
}

TEST(CostGrowth, OfReadingIsNearlyLinear) {
  const auto read = [](TextOf text_of) {
    return [text_of](int size) {
      return [text = text_of(size)] { EXPECT_TRUE(load_text(text).experiment); };
    };
  };
  for (const TextOf text_of : {contact_points, expressions, chains, links})
    expect_growth_below(1.7, 1000, read(text_of));
}

TEST(CostGrowth, OfStepsIsNearlyLinear) {
  for (const TextOf text_of : {contact_points, chains, links})
    expect_growth_below(1.7, 1000, [&](int size) {
      return [experiment = experiment_of(text_of(size))] {
        simulation::World world(experiment, simulation::make_dts(experiment));
        for (int i = 0; i < 50; ++i) EXPECT_TRUE(world.step().ok());
      };
    });
}

// Products and factorisations of matrices are cubic; the quartic would be 4.
TEST(CostGrowth, OfTheLargestStableStepIsCubicAtMost) {
  for (const TextOf text_of : {chains, links})
    expect_growth_below(3.4, 60, [&](int size) {
      return [experiment = experiment_of(text_of(size))] {
        EXPECT_EQ(simulation::stability_bound(experiment).not_computed, "");
      };
    });
}

// However large: the bound is left out where it would take too long.
TEST(CostGrowth, OfADynamicsReportIsBounded) {
  for (const TextOf text_of : {chains, links}) {
    const simulation::Experiment experiment = experiment_of(text_of(4000));
    const double begin = processor_time();
    EXPECT_FALSE(simulation::evaluate_dynamics(experiment).largest_stable_step);
    EXPECT_LT(processor_time() - begin, 20.);
  }
}

}  // namespace
}  // namespace hookpoint
