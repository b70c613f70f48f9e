// Order of convergence of every integrator against closed forms: a pendulum (complete elliptic
// integral) and a torque-free axisymmetric body (two turning exponentials); stability bounds
// against what the integrators do just below and above.
#include <gtest/gtest.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <complex>
#include <numbers>
#include <string>
#include <vector>

#include "integrators/stability_bound.h"
#include "integrators/stepper.h"
#include "tests/support/integrator_systems.h"

namespace hookpoint::integrators {
namespace {

using testing::OneCoordinate;
using testing::Pendulum;

/// x' ' = -2 t x' - 2 x: x = exp(-t^2). Its rates depend on time, which the stages must be given.
class TimeVarying final : public OneCoordinate {
 public:
  Status accelerations(Stage, double t, std::span<const double> q, std::span<const double> v,
                       std::span<double> a) override {
    a[0] = -2. * t * v[0] - 2. * q[0];
    return Status::ok;
  }
};

/// The free body whose rates may be taken for those of its tangent coordinates, which they are not.
class FreeBody final : public testing::FreeBody {
 public:
  bool rate_on_group = true;

  void tangent_rate(std::span<const double> u, std::span<const double> v,
                    std::span<double> du) const override {
    if (rate_on_group) return testing::FreeBody::tangent_rate(u, v, du);
    std::ranges::copy(v, du.begin());
  }
};

/// The rows that have an order and a stability bound.
std::vector<StepperDescription> fixed_steppers() {
  std::vector<StepperDescription> rows;
  for (const StepperDescription& row : stepper_table()) {
    if (!row.adaptive()) rows.push_back(row);
  }
  return rows;
}

void run(Stepper& stepper, System& system, double duration, int steps, std::span<double> q,
         std::span<double> v) {
  const double dt = duration / steps;
  for (int i = 0; i < steps; ++i) ASSERT_EQ(stepper.step(system, i * dt, dt, q, v), Status::ok);
}

/// Observed order: log2 of the ratio of errors with `steps` and twice as many.
template <class Error>
double order(Error error, int steps) {
  return std::log2(error(steps) / error(2 * steps));
}

double pendulum_error(std::string_view name, int steps) {
  Pendulum pendulum;
  const auto stepper = make_stepper(name, pendulum);
  const double amplitude = 2.;
  double q = amplitude, v = 0.;
  // A quarter of the period K(sin(amplitude/2)) after release it hangs straight down.
  run(*stepper, pendulum, std::comp_ellint_1(std::sin(amplitude / 2.)), steps, {&q, 1}, {&v, 1});
  return std::hypot(q, v + 2. * std::sin(amplitude / 2.));
}

double time_varying_error(std::string_view name, int steps) {
  TimeVarying system;
  const auto stepper = make_stepper(name, system);
  double q = 1., v = 0.;
  run(*stepper, system, 1.5, steps, {&q, 1}, {&v, 1});
  const double exact = std::exp(-2.25);
  return std::hypot(q - exact, v + 3. * exact);
}

double free_body_error(std::string_view name, int steps, bool rate_on_group = true) {
  FreeBody body;
  body.rate_on_group = rate_on_group;
  const auto stepper = make_stepper(name, body);
  const double duration = 2.;
  std::vector<double> q = FreeBody::start_orientation(), v = FreeBody::start_velocity();
  run(*stepper, body, duration, steps, q, v);
  EXPECT_NEAR(q[0] * q[0] + q[1] * q[1] + q[2] * q[2] + q[3] * q[3], 1., 1e-14);
  return FreeBody::angle_from_exact(duration, q);
}

TEST(IntegratorOrder, IsAsTheTableSaysOnAPendulum) {
  for (const StepperDescription& row : fixed_steppers()) {
    const double observed = order([&](int n) { return pendulum_error(row.name, n); }, 400);
    EXPECT_NEAR(observed, row.order, row.order == 1 ? 0.05 : 0.2) << row.name;
  }
}

TEST(IntegratorOrder, IsAsTheTableSaysWhenRatesDependOnTime) {
  for (const StepperDescription& row : fixed_steppers()) {
    const double observed = order([&](int n) { return time_varying_error(row.name, n); }, 400);
    EXPECT_NEAR(observed, row.order, row.order == 1 ? 0.05 : 0.2) << row.name;
  }
}

TEST(IntegratorOrder, IsAsTheTableSaysOnATumblingBody) {
  for (const StepperDescription& row : fixed_steppers()) {
    const int steps =
        row.order == 1 ? 1600 : 100;  // where the next term of the error no longer shows
    const double observed = order([&](int n) { return free_body_error(row.name, n); }, steps);
    EXPECT_NEAR(observed, row.order, row.order == 1 ? 0.05 : 0.2) << row.name;
    RecordProperty(std::string(row.name), std::to_string(observed));
  }
}

TEST(IntegratorOrder, NeedsTheTangentRateOnRotations) {
  const double observed = order([](int n) { return free_body_error("rk4", n, false); }, 100);
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

class Vibration final : public OneCoordinate {
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
double growth(std::string_view name, const Mode& mode, double dt) {
  Vibration system(mode);
  const auto stepper = make_stepper(name, system);
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

TEST(StabilityBound, IsWhereTheVibrationBeginsToGrow) {
  const double k = 3e4, m = 0.7;
  for (const double zeta : {0., 0.1, 0.3, 0.7, 0.95, 1.2, 5.}) {
    const Mode mode{k, zeta * 2. * std::sqrt(k * m), m};
    for (const StepperDescription& row : fixed_steppers()) {
      const double bound = largest_stable_step(row.name, mode).value();
      if (row.name == "explicit_euler" && zeta == 0.) {
        EXPECT_EQ(bound, 0.);
        EXPECT_GT(growth(row.name, mode, 0.05 / std::sqrt(k / m)), 1.1);
        continue;
      }
      EXPECT_LE(growth(row.name, mode, 0.99 * bound), 1.001) << row.name << " zeta " << zeta;
      EXPECT_GE(growth(row.name, mode, 1.01 * bound), 1.1) << row.name << " zeta " << zeta;
    }
  }
}

TEST(StabilityBound, HasTheTextbookLimits) {
  const Mode undamped{400., 0., 1.};  // w = 20
  EXPECT_NEAR(rk4_bound(undamped), 2. * std::numbers::sqrt2 / 20., 1e-12);
  EXPECT_NEAR(semi_implicit_euler_bound(undamped), 2. / 20., 1e-15);
  EXPECT_EQ(explicit_euler_bound(undamped), 0.);
  const Mode damper{0., 8., 1.};  // lambda = -8
  EXPECT_NEAR(explicit_euler_bound(damper), 2. / 8., 1e-15);
  EXPECT_NEAR(semi_implicit_euler_bound(damper), 2. / 8., 1e-15);
  EXPECT_NEAR(rk4_bound(damper), 2.785293563405282 / 8., 1e-12);
  EXPECT_NEAR(explicit_euler_bound({400., 10., 1.}), 10. / 400., 1e-15);
  for (const StepperDescription& row : fixed_steppers()) {
    EXPECT_TRUE(std::isinf(largest_stable_step(row.name, {0., 0., 1.}).value()));
  }
  EXPECT_FALSE(largest_stable_step("cvode_bdf", undamped).has_value());
}

TEST(StabilityBound, OfWhatGrowsIsNoneAndOfWhatDoesNothingAny) {
  for (const std::complex<double> grows :
       {std::complex{1., 0.}, {1e-3, 5.}, {1e-9, 5.}, {300., -1.}}) {
    EXPECT_EQ(rk4_bound(grows), 0.);
    EXPECT_EQ(explicit_euler_bound(grows), 0.);
  }
  EXPECT_TRUE(std::isinf(rk4_bound(std::complex{0., 0.})));
  EXPECT_TRUE(std::isinf(explicit_euler_bound(std::complex{0., 0.})));
}

}  // namespace
}  // namespace hookpoint::integrators
