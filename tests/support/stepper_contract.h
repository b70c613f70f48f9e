// What a caller of an integrator relies on, as a suite over descriptions of integrators: the
// stages, the state on failure, no allocation. A test that includes it says of which:
//
//   INSTANTIATE_TEST_SUITE_P(Table, StepperContract, ValuesIn(stepper_table()), StepperName{});
#pragma once

#include <gtest/gtest.h>

#include <limits>
#include <vector>

#include "integrators/stepper.h"
#include "tests/support/allocation_counter.h"
#include "tests/support/integrator_systems.h"

namespace hookpoint::integrators {

struct Call {
  Stage stage;
  double t, q, v;
};

/// x'' = -x that writes down how it was asked, and fails at the evaluation `fail_at`.
class Recorded final : public hookpoint::testing::OneCoordinate {
 public:
  std::vector<Call> calls;
  int fail_at = -1;
  bool overflow = false;

  Recorded() { calls.reserve(64); }
  Status accelerations(Stage stage, double t, std::span<const double> q, std::span<const double> v,
                       std::span<double> a) override {
    if (static_cast<int>(calls.size()) == fail_at) return Status::not_finite;
    if (calls.size() < calls.capacity()) calls.push_back({stage, t, q[0], v[0]});
    a[0] = overflow ? std::numeric_limits<double>::infinity() : -q[0];
    return Status::ok;
  }
};

class StepperContract : public ::testing::TestWithParam<StepperDescription> {};

TEST_P(StepperContract, AsksFirstAtTheAcceptedStateOnceAndThenOnlyTries) {
  const StepperDescription& row = GetParam();
  Recorded system;
  const auto stepper = row.make(system, {});
  double q = 1., v = 0.5;
  for (int i = 0; i < 3; ++i) {
    system.calls.clear();
    const double q_before = q, v_before = v;
    ASSERT_EQ(stepper->step(system, 0.1 * i, 0.1, {&q, 1}, {&v, 1}), Status::ok);
    if (!row.adaptive()) {
      ASSERT_EQ(system.calls.size(), static_cast<std::size_t>(row.evaluations));
    }
    for (std::size_t k = 0; k < system.calls.size(); ++k) {
      EXPECT_EQ(system.calls[k].stage, k == 0 ? Stage::first : Stage::trial);
    }
    EXPECT_EQ(system.calls[0].t, 0.1 * i);
    EXPECT_EQ(system.calls[0].q, q_before);
    EXPECT_EQ(system.calls[0].v, v_before);
  }
}

TEST_P(StepperContract, LeavesTheStateAloneWhenAStepFails) {
  const StepperDescription& row = GetParam();
  if (row.adaptive()) return;  // integrators_adaptive_test
  for (int fail_at = 0; fail_at <= row.evaluations; ++fail_at) {
    Recorded system;
    system.fail_at = fail_at;
    system.overflow = fail_at == row.evaluations;  // then only the new state is not finite
    double q = 1., v = 0.5;
    EXPECT_EQ(row.make(system, {})->step(system, 0., 0.1, {&q, 1}, {&v, 1}), Status::not_finite);
    EXPECT_EQ(q, 1.);
    EXPECT_EQ(v, 0.5);
  }
}

TEST_P(StepperContract, AllocatesNothingInAStep) {
  Recorded system;
  const auto stepper = GetParam().make(system, {});
  double q = 1., v = 0.5;
  stepper->step(system, 0., 0.1, {&q, 1}, {&v, 1});
  const long before = hookpoint::testing::allocation_count();
  for (int i = 0; i < 10; ++i) stepper->step(system, 0., 0.1, {&q, 1}, {&v, 1});
  EXPECT_EQ(hookpoint::testing::allocation_count(), before);
  EXPECT_GT(before, 0);
}

/// The weights that a step gives to its evaluations add up to its length.
class Weighed final : public hookpoint::testing::OneCoordinate {
 public:
  double sum = 0.;
  Status accelerations(Stage, double, std::span<const double> q, std::span<const double>,
                       std::span<double> a) override {
    a[0] = -q[0];
    return Status::ok;
  }
  void weigh(double weight) override { sum += weight; }
};

TEST_P(StepperContract, WeighsItsEvaluationsByTheStepInAll) {
  if (GetParam().adaptive()) return;  // by a quadrature of its own: contact_force_mean_test
  Weighed system;
  const auto stepper = GetParam().make(system, {});
  double q = 1., v = 0.5;
  stepper->step(system, 0., 0.1, {&q, 1}, {&v, 1});
  EXPECT_NEAR(system.sum, 0.1, 1e-16);
}

}  // namespace hookpoint::integrators
