// Order of convergence of every integrator against closed forms: a pendulum (complete elliptic
// integral) and a torque-free axisymmetric body (two turning exponentials); stability bounds
// against what the integrators do just below and above.
#include <gtest/gtest.h>

#include <array>
#include <cmath>
#include <numbers>
#include <string>
#include <vector>

#include "integrators/rotation_rate.h"
#include "integrators/stability_bound.h"
#include "integrators/stepper.h"

namespace hookpoint::integrators {
namespace {

/// A system of one coordinate in a vector space.
class OneCoordinate : public System {
 public:
  std::size_t position_size() const override { return 1; }
  std::size_t velocity_size() const override { return 1; }
  void retract(std::span<const double> q0, std::span<const double> u,
               std::span<double> q_out) const override {
    q_out[0] = q0[0] + u[0];
  }
  void tangent_rate(std::span<const double>, std::span<const double> v,
                    std::span<double> du) const override {
    du[0] = v[0];
  }
};

class Pendulum final : public OneCoordinate {
 public:
  Status accelerations(Stage, double, std::span<const double> q, std::span<const double>,
                       std::span<double> a) override {
    a[0] = -std::sin(q[0]);
    return Status::ok;
  }
};

/// x' ' = -2 t x' - 2 x: x = exp(-t^2). Its rates depend on time, which the stages must be given.
class TimeVarying final : public OneCoordinate {
 public:
  Status accelerations(Stage, double t, std::span<const double> q, std::span<const double> v,
                       std::span<double> a) override {
    a[0] = -2. * t * v[0] - 2. * q[0];
    return Status::ok;
  }
};

/// A free body with principal moments (A, A, C) about its own axes; q = orientation w,x,y,z, v =
/// w_WB.
class FreeBody final : public System {
 public:
  static constexpr double A = 1., C = 2.2;
  bool rate_on_group = true;

  std::size_t position_size() const override { return 4; }
  std::size_t velocity_size() const override { return 3; }
  Status accelerations(Stage, double, std::span<const double> q, std::span<const double> v,
                       std::span<double> a) override {
    const Matrix3d R = rotation_matrix(Quaterniond{q[0], q[1], q[2], q[3]});
    const Vector3d w{v[0], v[1], v[2]};
    const Vector3d in_body = transpose_times(R, w);
    const Vector3d L{A * in_body.x, A * in_body.y, C * in_body.z};
    const Vector3d torque = -cross(in_body, L);
    const Vector3d dw = R * Vector3d{torque.x / A, torque.y / A, torque.z / C};
    a[0] = dw.x, a[1] = dw.y, a[2] = dw.z;
    return Status::ok;
  }
  void retract(std::span<const double> q0, std::span<const double> u,
               std::span<double> q_out) const override {
    const Quaterniond q =
        rotation_retract(Quaterniond{q0[0], q0[1], q0[2], q0[3]}, Vector3d{u[0], u[1], u[2]});
    q_out[0] = q.w, q_out[1] = q.x, q_out[2] = q.y, q_out[3] = q.z;
  }
  void tangent_rate(std::span<const double> u, std::span<const double> v,
                    std::span<double> du) const override {
    const Vector3d w{v[0], v[1], v[2]};
    const Vector3d rate = rate_on_group ? rotation_tangent_rate(Vector3d{u[0], u[1], u[2]}, w) : w;
    du[0] = rate.x, du[1] = rate.y, du[2] = rate.z;
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
  const Quaterniond start = from_roll_pitch_yaw(0.3, -0.7, 1.9);
  const Vector3d w_body{1.1, -0.4, 1.7};
  const Vector3d w = rotate(start, w_body);
  std::array q{start.w, start.x, start.y, start.z};
  std::array v{w.x, w.y, w.z};
  run(*stepper, body, duration, steps, q, v);
  // R(t) = exp(t L/A) R(0) exp(t (1 - C/A) w3 e3): precession about L and spin about the symmetry
  // axis.
  const Vector3d L = rotate(
      start, Vector3d{FreeBody::A * w_body.x, FreeBody::A * w_body.y, FreeBody::C * w_body.z});
  const Quaterniond exact =
      exponential((duration / FreeBody::A) * L) * start *
      exponential(Vector3d{0., 0., duration * (1. - FreeBody::C / FreeBody::A) * w_body.z});
  const Quaterniond error = conjugate(exact) * Quaterniond{q[0], q[1], q[2], q[3]};
  EXPECT_NEAR(q[0] * q[0] + q[1] * q[1] + q[2] * q[2] + q[3] * q[3], 1., 1e-14);
  return std::hypot(error.x, error.y, error.z);
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

}  // namespace
}  // namespace hookpoint::integrators
