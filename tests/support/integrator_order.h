// Order of convergence and stability of integrators with fixed steps, as a suite over their
// descriptions: against closed forms, a pendulum (complete elliptic integral) and a torque-free
// axisymmetric body (two turning exponentials); stability bounds against what the integrator does
// just below and above. A test that includes it says of which:
//
//   INSTANTIATE_TEST_SUITE_P(Table, IntegratorOrder, ValuesIn(fixed_steppers()), StepperName{});
#pragma once

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <string>
#include <vector>

#include "integrators/stepper.h"
#include "tests/support/integrator_systems.h"

namespace hookpoint::integrators {

/// x' ' = -2 t x' - 2 x: x = exp(-t^2). Its rates depend on time, which the stages must be given.
class TimeVarying final : public hookpoint::testing::OneCoordinate {
 public:
  Status accelerations(Stage, double t, std::span<const double> q, std::span<const double> v,
                       std::span<double> a) override {
    a[0] = -2. * t * v[0] - 2. * q[0];
    return Status::ok;
  }
};

/// The free body whose rates may be taken for those of its tangent coordinates, which they are not.
class FreeBody final : public hookpoint::testing::FreeBody {
 public:
  bool rate_on_group = true;

  void tangent_rate(std::span<const double> u, std::span<const double> v,
                    std::span<double> du) const override {
    if (rate_on_group) return hookpoint::testing::FreeBody::tangent_rate(u, v, du);
    std::ranges::copy(v, du.begin());
  }
};

inline void run(Stepper& stepper, System& system, double duration, int steps, std::span<double> q,
                std::span<double> v) {
  const double dt = duration / steps;
  for (int i = 0; i < steps; ++i) ASSERT_EQ(stepper.step(system, i * dt, dt, q, v), Status::ok);
}

/// Observed order: log2 of the ratio of errors with `steps` and twice as many.
template <class Error>
double observed_order(Error error, int steps) {
  return std::log2(error(steps) / error(2 * steps));
}

inline double pendulum_error(const StepperDescription& method, int steps) {
  hookpoint::testing::Pendulum pendulum;
  const auto stepper = method.make(pendulum, {});
  const double amplitude = 2.;
  double q = amplitude, v = 0.;
  // A quarter of the period K(sin(amplitude/2)) after release it hangs straight down.
  run(*stepper, pendulum, std::comp_ellint_1(std::sin(amplitude / 2.)), steps, {&q, 1}, {&v, 1});
  return std::hypot(q, v + 2. * std::sin(amplitude / 2.));
}

inline double time_varying_error(const StepperDescription& method, int steps) {
  TimeVarying system;
  const auto stepper = method.make(system, {});
  double q = 1., v = 0.;
  run(*stepper, system, 1.5, steps, {&q, 1}, {&v, 1});
  const double exact = std::exp(-2.25);
  return std::hypot(q - exact, v + 3. * exact);
}

inline double free_body_error(const StepperDescription& method, int steps,
                              bool rate_on_group = true) {
  FreeBody body;
  body.rate_on_group = rate_on_group;
  const auto stepper = method.make(body, {});
  const double duration = 2.;
  std::vector<double> q = FreeBody::start_orientation(), v = FreeBody::start_velocity();
  run(*stepper, body, duration, steps, q, v);
  EXPECT_NEAR(q[0] * q[0] + q[1] * q[1] + q[2] * q[2] + q[3] * q[3], 1., 1e-14);
  return FreeBody::angle_from_exact(duration, q);
}

class Vibration final : public hookpoint::testing::OneCoordinate {
 public:
  explicit Vibration(const Mode& mode) : mode_(mode) {}
  Status accelerations(Stage, double, std::span<const double> q, std::span<const double> v,
                       std::span<double> a) override {
    a[0] = -(mode_.stiffness * q[0] + mode_.damping * v[0]) / mode_.mass;
    return Status::ok;
  }

 private:
  Mode mode_;
};

/// How much more the vibration moves in the last quarter of 4000 steps than in the first.
inline double growth(const StepperDescription& method, const Mode& mode, double dt) {
  Vibration system(mode);
  const auto stepper = method.make(system, {});
  const double w = std::sqrt(mode.stiffness / mode.mass);
  double q = 1., v = 0.3 * w;
  double first = 0., last = 0.;
  for (int i = 0; i < 4000; ++i) {
    if (stepper->step(system, i * dt, dt, {&q, 1}, {&v, 1}) != Status::ok) return INFINITY;
    double& most = i < 1000 ? first : last;
    if (i < 1000 || i >= 3000) most = std::max(most, std::hypot(q, v / w));
  }
  return last / first;
}

class IntegratorOrder : public ::testing::TestWithParam<StepperDescription> {
 protected:
  /// Of the order that the description states.
  static double tolerance() { return GetParam().order == 1 ? 0.05 : 0.2; }
};

TEST_P(IntegratorOrder, IsAsDescribedOnAPendulum) {
  const double observed = observed_order([](int n) { return pendulum_error(GetParam(), n); }, 400);
  EXPECT_NEAR(observed, GetParam().order, tolerance());
}

TEST_P(IntegratorOrder, IsAsDescribedWhenRatesDependOnTime) {
  const double observed =
      observed_order([](int n) { return time_varying_error(GetParam(), n); }, 400);
  EXPECT_NEAR(observed, GetParam().order, tolerance());
}

TEST_P(IntegratorOrder, IsAsDescribedOnATumblingBody) {
  // Where the next term of the error no longer shows.
  const int steps = GetParam().order == 1 ? 1600 : 100;
  const double observed =
      observed_order([](int n) { return free_body_error(GetParam(), n); }, steps);
  EXPECT_NEAR(observed, GetParam().order, tolerance());
  RecordProperty("order", std::to_string(observed));
}

class IntegratorStability : public ::testing::TestWithParam<StepperDescription> {};

TEST_P(IntegratorStability, EndsWhereTheVibrationBeginsToGrow) {
  const double k = 3e4, m = 0.7;
  for (const double zeta : {0., 0.1, 0.3, 0.7, 0.95, 1.2, 5.}) {
    const Mode mode{k, zeta * 2. * std::sqrt(k * m), m};
    const double bound = largest_stable_step(GetParam(), mode);
    if (bound == 0.) {
      EXPECT_GT(growth(GetParam(), mode, 0.05 / std::sqrt(k / m)), 1.1) << "zeta " << zeta;
      continue;
    }
    EXPECT_LE(growth(GetParam(), mode, 0.99 * bound), 1.001) << "zeta " << zeta;
    EXPECT_GE(growth(GetParam(), mode, 1.01 * bound), 1.1) << "zeta " << zeta;
  }
}

// What an integrator says of its stability is what its steps do.
TEST_P(IntegratorStability, SaysWhatItsStepsDo) {
  StepperDescription silent = GetParam();
  silent.stability = BoundFromSteps{};
  for (const double zeta : {0.1, 0.3, 0.7, 0.95, 1.2, 5.}) {
    const Mode mode{400., zeta * 40., 1.};
    EXPECT_NEAR(largest_stable_step(silent, mode) / largest_stable_step(GetParam(), mode), 1., 1e-6)
        << "zeta " << zeta;
  }
}

TEST_P(IntegratorStability, OfWhatFeelsNoForceIsAnyStep) {
  EXPECT_TRUE(std::isinf(largest_stable_step(GetParam(), {0., 0., 1.})));
}

}  // namespace hookpoint::integrators
