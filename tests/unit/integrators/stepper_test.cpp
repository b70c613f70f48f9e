// What a caller of an integrator relies on, for every row of the table, and the table of names.
// ctest: alone
#include "integrators/stepper.h"

#include <gtest/gtest.h>

#include "tests/support/stepper_contract.h"

namespace hookpoint::integrators {
namespace {

INSTANTIATE_TEST_SUITE_P(Table, StepperContract, ::testing::ValuesIn(stepper_table()),
                         hookpoint::testing::StepperName{});

TEST(Stepper, TakesTheStepsOfItsFormula) {
  const double dt = 0.1;
  const auto stepped = [&](std::string_view name) {
    Recorded system;
    double q = 1., v = 0.5;
    EXPECT_EQ(make_stepper(name, system)->step(system, 0., dt, {&q, 1}, {&v, 1}), Status::ok);
    return std::pair{q, v};
  };
  EXPECT_EQ(stepped("explicit_euler"), std::pair(1. + dt * 0.5, 0.5 - dt));
  EXPECT_EQ(stepped("semi_implicit_euler"), std::pair(1. + dt * (0.5 - dt), 0.5 - dt));
  // RK4 on x'' = -x is the Taylor series of the exact turn up to dt^4.
  const double c = 1. - dt * dt / 2. + dt * dt * dt * dt / 24.;
  const double s = dt - dt * dt * dt / 6.;
  const auto [q, v] = stepped("rk4");
  EXPECT_NEAR(q, c + 0.5 * s, 1e-15);
  EXPECT_NEAR(v, 0.5 * c - s, 1e-15);
}

TEST(Stepper, IsFoundByName) {
  Recorded system;
  for (const StepperDescription& row : stepper_table()) {
    EXPECT_EQ(find_stepper(row.name), &row);
    EXPECT_NE(make_stepper(row.name, system), nullptr);
  }
  EXPECT_GE(stepper_table().size(), 7u);  // none is lost
  EXPECT_EQ(find_stepper("rk5"), nullptr);
  EXPECT_EQ(make_stepper("", system), nullptr);
}

}  // namespace
}  // namespace hookpoint::integrators
