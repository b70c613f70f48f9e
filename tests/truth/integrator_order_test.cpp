// Order of convergence and stability of every fixed-step integrator of the table
// (tests/support/integrator_order.h); textbook limits of their stability.
// ctest: alone
#include "tests/support/integrator_order.h"

#include <gtest/gtest.h>

#include <cmath>
#include <complex>
#include <numbers>
#include <vector>

#include "integrators/cvode.h"
#include "integrators/explicit_euler.h"
#include "integrators/rk4.h"
#include "integrators/semi_implicit_euler.h"

namespace hookpoint::integrators {
namespace {

/// The rows that have an order and a stability bound.
std::vector<StepperDescription> fixed_steppers() {
  std::vector<StepperDescription> rows;
  for (const StepperDescription& row : stepper_table()) {
    if (!row.adaptive()) rows.push_back(row);
  }
  return rows;
}

INSTANTIATE_TEST_SUITE_P(Table, IntegratorOrder, ::testing::ValuesIn(fixed_steppers()),
                         hookpoint::testing::StepperName{});
INSTANTIATE_TEST_SUITE_P(Table, IntegratorStability, ::testing::ValuesIn(fixed_steppers()),
                         hookpoint::testing::StepperName{});

TEST(TangentRate, KeepsTheOrderOnRotations) {
  const double observed = observed_order([](int n) { return free_body_error(rk4, n, false); }, 100);
  EXPECT_LT(observed, 3.3);
}

TEST(RotationRate, IsTheDerivativeOfTheRetraction) {
  const Quaterniond start = from_roll_pitch_yaw(0.3, -0.7, 1.9);
  const Vector3d w{0.7, -1.2, 0.4};
  for (const double size : {0., 1e-6, 0.009, 0.011, 0.5, 2., 6.}) {
    const Vector3d u = size * Vector3d{0.6, 0., 0.8};
    const Vector3d du = rotation_tangent_rate(u, w);
    const double h = 2e-6;
    const Quaterniond turn =
        rotation_retract(start, u + h * du) * conjugate(rotation_retract(start, u - h * du));
    const Vector3d observed = (1. / h) * Vector3d{turn.x, turn.y, turn.z};
    EXPECT_LE(norm(observed - w), 3e-9) << size;
  }
}

TEST(StabilityBound, HasTheTextbookLimits) {
  const Mode undamped{400., 0., 1.};  // w = 20
  EXPECT_NEAR(largest_stable_step(rk4, undamped), 2. * std::numbers::sqrt2 / 20., 1e-12);
  EXPECT_NEAR(largest_stable_step(semi_implicit_euler, undamped), 2. / 20., 1e-15);
  EXPECT_EQ(largest_stable_step(explicit_euler, undamped), 0.);
  const Mode damper{0., 8., 1.};  // lambda = -8
  EXPECT_NEAR(largest_stable_step(explicit_euler, damper), 2. / 8., 1e-15);
  EXPECT_NEAR(largest_stable_step(semi_implicit_euler, damper), 2. / 8., 1e-15);
  EXPECT_NEAR(largest_stable_step(rk4, damper), 2.785293563405282 / 8., 1e-12);
  EXPECT_NEAR(largest_stable_step(explicit_euler, {400., 10., 1.}), 10. / 400., 1e-15);
  EXPECT_TRUE(std::isinf(largest_stable_step(cvode_bdf, undamped)));
}

TEST(StabilityBound, OfWhatGrowsIsNoneAndOfWhatDoesNothingAny) {
  for (const std::complex<double> grows :
       {std::complex{1., 0.}, {1e-3, 5.}, {1e-9, 5.}, {300., -1.}}) {
    EXPECT_EQ(RungeKutta4::largest_step(grows), 0.);
    EXPECT_EQ(ExplicitEuler::largest_step(grows), 0.);
  }
  EXPECT_TRUE(std::isinf(RungeKutta4::largest_step(std::complex{0., 0.})));
  EXPECT_TRUE(std::isinf(ExplicitEuler::largest_step(std::complex{0., 0.})));
}

}  // namespace
}  // namespace hookpoint::integrators
