// Times as numbers of steps: the nearest whole number, and where there is none.
#include "simulation/engine_interface/step_count.h"

#include <gtest/gtest.h>

#include <cmath>
#include <limits>

#include "simulation/engine_interface/engine.h"

namespace hookpoint::simulation {
namespace {

TEST(StepCount, IsTheNearestWholeNumber) {
  EXPECT_EQ(step_count(1., 1e-3), 1000);
  EXPECT_EQ(step_count(0.3, 0.1), 3) << "0.3 / 0.1 is just below 3";
  EXPECT_EQ(step_count(0., 1e-3), 0);
  EXPECT_EQ(step_count(-0.002, 1e-3), -2);
  EXPECT_EQ(step_count(0.0149, 0.01), 1);
}

TEST(StepCount, EndsWhereADoubleHoldsNotEachWholeNumber) {
  const double most = 9007199254740992.;  // 2^53
  EXPECT_EQ(static_cast<double>(most_steps), most);
  EXPECT_EQ(step_count(most, 1.), most_steps);
  EXPECT_EQ(step_count_problem(most, 1.), "");
  const double endless = std::numeric_limits<double>::infinity();
  for (const double time :
       {std::nextafter(most, endless), 1e300, endless, -endless, std::nan("")}) {
    EXPECT_THROW(step_count(time, 1.), ExperimentError) << time;
    EXPECT_NE(step_count_problem(time, 1.), "") << time;
  }
  EXPECT_EQ(step_count_problem(1e17, 1e-3),
            "1e+17 s in steps of 0.001 s are more steps than a run can count (9007199254740992): "
            "shorten the duration or lengthen the step");
  EXPECT_NE(step_count_problem(1e300, 1e-300), "") << "a quotient that overflows";
}

TEST(StepCount, OfARunThatDoesNotMoveIsAProblem) {
  EXPECT_EQ(no_step_problem(0.4, 1.),
            "0.4 s are less than half a step of 1 s: the run takes none; lengthen the duration or "
            "shorten the step");
  EXPECT_EQ(no_step_problem(0.5, 1.), "");
  EXPECT_EQ(no_step_problem(0., 1.), "") << "nobody wants it to move";
}

}  // namespace
}  // namespace hookpoint::simulation
