// What a caller of an integrator relies on: the stages, the state on failure, no allocation, the
// table of names.
#include <gtest/gtest.h>

#include <limits>

#include "integrators/hybrid_system.h"
#include "integrators/stepper.h"
#include "tests/support/allocation_counter.h"

namespace hookpoint::integrators {
namespace {

struct Call {
  Stage stage;
  double t, q, v;
};

/// x'' = -x that writes down how it was asked, and fails at the evaluation `fail_at`.
class Recorded final : public HybridSystem {
 public:
  std::vector<Call> calls;
  int fail_at = -1;
  bool overflow = false;

  std::size_t position_size() const override { return 1; }
  std::size_t velocity_size() const override { return 1; }
  Status accelerations(Stage stage, double t, std::span<const double> q, std::span<const double> v,
                       std::span<double> a) override {
    if (static_cast<int>(calls.size()) == fail_at) return Status::not_finite;
    if (calls.size() < calls.capacity()) calls.push_back({stage, t, q[0], v[0]});
    a[0] = overflow ? std::numeric_limits<double>::infinity() : -q[0];
    return Status::ok;
  }
  void retract(std::span<const double> q0, std::span<const double> u,
               std::span<double> q_out) const override {
    q_out[0] = q0[0] + u[0];
  }
  void tangent_rate(std::span<const double>, std::span<const double> v,
                    std::span<double> du) const override {
    du[0] = v[0];
  }
};

TEST(Stepper, AsksFirstAtTheAcceptedStateOnceAndThenOnlyTries) {
  for (const StepperDescription& row : stepper_table()) {
    Recorded system;
    system.calls.reserve(64);
    const auto stepper = row.make(system, {});
    double q = 1., v = 0.5;
    for (int i = 0; i < 3; ++i) {
      system.calls.clear();
      const double q_before = q, v_before = v;
      ASSERT_EQ(stepper->step(system, 0.1 * i, 0.1, {&q, 1}, {&v, 1}), Status::ok);
      if (!row.adaptive()) {
        ASSERT_EQ(system.calls.size(), static_cast<std::size_t>(row.evaluations)) << row.name;
      }
      for (std::size_t k = 0; k < system.calls.size(); ++k) {
        EXPECT_EQ(system.calls[k].stage, k == 0 ? Stage::first : Stage::trial);
      }
      EXPECT_EQ(system.calls[0].t, 0.1 * i);
      EXPECT_EQ(system.calls[0].q, q_before);
      EXPECT_EQ(system.calls[0].v, v_before);
    }
  }
}

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

TEST(Stepper, LeavesTheStateAloneWhenAStepFails) {
  for (const StepperDescription& row : stepper_table()) {
    if (row.adaptive()) continue;  // integrators_adaptive_test
    for (int fail_at = 0; fail_at <= row.evaluations; ++fail_at) {
      Recorded system;
      system.calls.reserve(64);
      system.fail_at = fail_at;
      system.overflow = fail_at == row.evaluations;  // then only the new state is not finite
      double q = 1., v = 0.5;
      EXPECT_EQ(row.make(system, {})->step(system, 0., 0.1, {&q, 1}, {&v, 1}), Status::not_finite);
      EXPECT_EQ(q, 1.);
      EXPECT_EQ(v, 0.5);
    }
  }
}

TEST(Stepper, AllocatesNothingInAStep) {
  for (const StepperDescription& row : stepper_table()) {
    Recorded system;
    const auto stepper = row.make(system, {});
    double q = 1., v = 0.5;
    stepper->step(system, 0., 0.1, {&q, 1}, {&v, 1});
    const long before = testing::allocation_count();
    for (int i = 0; i < 10; ++i) stepper->step(system, 0., 0.1, {&q, 1}, {&v, 1});
    EXPECT_EQ(testing::allocation_count(), before) << row.name;
    EXPECT_GT(before, 0);
  }
}

TEST(Stepper, IsFoundByName) {
  Recorded system;
  for (const StepperDescription& row : stepper_table()) {
    EXPECT_EQ(find_stepper(row.name), &row);
    EXPECT_NE(make_stepper(row.name, system), nullptr);
  }
  EXPECT_EQ(stepper_table().size(), 7u);
  EXPECT_EQ(find_stepper("rk5"), nullptr);
  EXPECT_EQ(make_stepper("", system), nullptr);
}

}  // namespace
}  // namespace hookpoint::integrators
