// What a caller of an adaptive integrator relies on beside what every integrator promises: the
// state on failure, runs that are resumed, memory that is committed once a step, no allocation.
#include "integrators/adaptive.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <cstdlib>
#include <limits>
#include <stdexcept>
#include <vector>

#include "integrators/stepper.h"
#include "tests/support/integrator_systems.h"
#include "tests/support/malloc_counter.h"

namespace hookpoint::integrators {
namespace {

using testing::Ball;
using testing::FreeBody;
using testing::mallocs;
using testing::OneCoordinate;
using testing::Pendulum;

template <class Check>
void for_each_adaptive(Check check) {
  for (const StepperDescription& row : stepper_table()) {
    if (row.adaptive()) check(row);
  }
}

/// Of which something is integrated along its way: the whole time, to have something to check.
class Weighed final : public FreeBody {
 public:
  double weight = 0.;
  bool has_integrals() const override { return true; }
  void weigh_at(double part, std::span<const double>, std::span<const double>) override {
    weight += part;
  }
};

// The library makes a vector's header (three small blocks) for each Jacobian by difference
// quotients, and nothing else.
TEST(AdaptiveStepper, AllocatesOnlyForJacobiansAfterItsFirstStep) {
  for_each_adaptive([](const StepperDescription& row) {
    Weighed body;
    const auto stepper = row.make(body, {});
    std::vector<double> q = FreeBody::start_orientation(), v = FreeBody::start_velocity();
    stepper->step(body, 0., 0.1, q, v);
    const long before = mallocs;
    const double jacobians = stepper->statistics().jacobians;
    for (int i = 1; i < 100; ++i) stepper->step(body, 0.1 * i, 0.1, q, v);
    const double made = stepper->statistics().jacobians - jacobians;
    EXPECT_LE(static_cast<double>(mallocs - before), 3. * made) << row.name;
    const bool implicit = row.name == "cvode_bdf" || row.name == "arkode_imex";
    EXPECT_EQ(made > 0., implicit) << row.name;
    EXPECT_NEAR(body.weight, 10., 1e-12) << row.name;
  });
}

TEST(AdaptiveStepper, GoesOnBitForBitFromASavedState) {
  for_each_adaptive([](const StepperDescription& row) {
    FreeBody body;
    const auto stepper = row.make(body, {});
    std::vector<double> q = FreeBody::start_orientation(), v = FreeBody::start_velocity();
    for (int i = 0; i < 10; ++i) stepper->step(body, 0.1 * i, 0.1, q, v);
    std::array<double, Stepper::state_size()> state{};
    stepper->save(state);
    const auto resumed = row.make(body, {});
    resumed->restore(state);
    std::vector<double> resumed_q = q, resumed_v = v;
    for (int i = 10; i < 20; ++i) {
      stepper->step(body, 0.1 * i, 0.1, q, v);
      resumed->step(body, 0.1 * i, 0.1, resumed_q, resumed_v);
    }
    EXPECT_EQ(resumed_q, q) << row.name;
    EXPECT_EQ(resumed_v, v) << row.name;
    EXPECT_EQ(resumed->statistics().evaluations, stepper->statistics().evaluations) << row.name;
  });
}

/// Has no accelerations after t = 1/2, however short the step.
class Ending final : public OneCoordinate {
 public:
  Status accelerations(Stage, double t, std::span<const double>, std::span<const double>,
                       std::span<double> a) override {
    a[0] = 1.;
    return t > 0.5 ? Status::not_finite : Status::ok;
  }
};

TEST(AdaptiveStepper, LeavesTheStateAloneWhenItFindsNoStep) {
  for_each_adaptive([](const StepperDescription& row) {
    for (const double start : {0., 1.}) {
      Ending system;
      double q = 1., v = 0.5;
      const Status status = row.make(system, {})->step(system, start, 1., {&q, 1}, {&v, 1});
      EXPECT_EQ(status == Status::ok, false) << row.name;
      EXPECT_EQ(status == Status::not_finite || start == 0., true) << row.name;
      EXPECT_EQ(q, 1.) << row.name;
      EXPECT_EQ(v, 0.5) << row.name;
    }
  });
}

/// x'' = -w^2 x, w = 1e7 rad/s: a second of it has more than a million swings.
class Humming final : public OneCoordinate {
 public:
  Status accelerations(Stage, double, std::span<const double> q, std::span<const double>,
                       std::span<double> a) override {
    a[0] = -1e14 * q[0];
    return Status::ok;
  }
};

TEST(AdaptiveStepper, GivesUpAStepThatNeedsTooMuch) {
  for_each_adaptive([](const StepperDescription& row) {
    Humming system;
    double q = 1., v = 0.;
    const auto stepper = row.make(system, {});
    EXPECT_EQ(stepper->step(system, 0., 1., {&q, 1}, {&v, 1}), Status::too_long) << row.name;
    EXPECT_EQ(q, 1.) << row.name;
    EXPECT_EQ(v, 0.) << row.name;
    EXPECT_LE(stepper->statistics().evaluations, 300010.) << row.name;
    // Only this step was too long.
    EXPECT_EQ(stepper->step(system, 0., 1e-6, {&q, 1}, {&v, 1}), Status::ok) << row.name;
  });
}

/// Stiff springs side by side, each coupled to all: a full Jacobian of 2 n unknowns, and thousands
/// of swings a second.
class Springs final : public HybridSystem {
 public:
  explicit Springs(std::size_t n) : n_(n) {}
  std::size_t position_size() const override { return n_; }
  std::size_t velocity_size() const override { return n_; }
  void retract(std::span<const double> q0, std::span<const double> u,
               std::span<double> q) const override {
    for (std::size_t i = 0; i < n_; ++i) q[i] = q0[i] + u[i];
  }
  void tangent_rate(std::span<const double>, std::span<const double> v,
                    std::span<double> du) const override {
    std::ranges::copy(v, du.begin());
  }
  Status accelerations(Stage, double, std::span<const double> q, std::span<const double>,
                       std::span<double> a) override {
    double sum = 0.;
    for (const double x : q) sum += x;
    for (std::size_t i = 0; i < n_; ++i) a[i] = -1e8 * (q[i] + 0.1 * sum);
    return Status::ok;
  }
  Status split_accelerations(double t, std::span<const double> q, std::span<const double> v,
                             std::span<double> a_free, std::span<double> a_contact) override {
    std::ranges::fill(a_free, 0.);
    return accelerations(Stage::trial, t, q, v, a_contact);
  }

 private:
  std::size_t n_;
};

// A full Jacobian of n unknowns takes n^3/3 multiplications to be factorised.
TEST(AdaptiveStepper, FactorisesNoMoreThanItsWorkAllows) {
  constexpr std::size_t unknowns = 600;
  const double each = std::pow(unknowns, 3) / 3.;
  for (const char* name : {"cvode_bdf", "arkode_imex"}) {
    Springs system(unknowns / 2);
    std::vector<double> q(unknowns / 2, 1e-3), v(unknowns / 2, 0.);
    const auto stepper = make_stepper(name, system, {1e-9, 1e-12});
    EXPECT_EQ(stepper->step(system, 0., 1., q, v), Status::too_long) << name;
    const Spending spent = dynamic_cast<const AdaptiveStepper&>(*stepper).spending();
    EXPECT_EQ(spent.unknowns, unknowns);
    EXPECT_GT(spent.factorisations, 5) << name;
    EXPECT_LT(each * static_cast<double>(spent.factorisations), 1.1 * most_work) << name;
    EXPECT_EQ(q, std::vector<double>(unknowns / 2, 1e-3)) << name;
  }
}

TEST(AdaptiveStepper, IsNotMadeForMoreUnknownsThanItCouldSolveFor) {
  const auto most = static_cast<std::size_t>(std::cbrt(3. * most_work));
  Springs fits(most / 2 - 1), large(most / 2 + 1);
  for (const char* name : {"cvode_bdf", "arkode_imex"}) {
    EXPECT_NO_THROW(make_stepper(name, fits)) << name;
    EXPECT_THROW(make_stepper(name, large), TooManyUnknowns) << name;
  }
  for (const char* name : {"cvode_adams", "arkode"}) EXPECT_NO_THROW(make_stepper(name, large));
}

TEST(AdaptiveStepper, IsNotMadeOfWhatTheLibraryRefuses) {
  for_each_adaptive([](const StepperDescription& row) {
    Pendulum system;
    EXPECT_THROW(row.make(system, {-1e-6, 1e-8}), std::runtime_error) << row.name;
    EXPECT_THROW(row.make(system, {1e-6, -1e-8}), std::runtime_error) << row.name;
  });
}

/// x = t - t^2/4 passes 3/4 upwards at t = 1 and downwards at t = 3.
class Tossed final : public OneCoordinate {
 public:
  std::vector<int> directions;
  Status accelerations(Stage, double, std::span<const double>, std::span<const double>,
                       std::span<double> a) override {
    a[0] = -0.5;
    return Status::ok;
  }
  std::size_t event_count() const override { return 2; }
  void event_values(double, std::span<const double> q, std::span<const double>,
                    std::span<double> values) override {
    values[0] = 1.;
    values[1] = q[0] - 0.75;
  }
  void cross_events(std::span<const int> crossed) override {
    EXPECT_EQ(crossed[0], 0);
    directions.push_back(crossed[1]);
  }
};

TEST(AdaptiveStepper, TellsWhichWayAnEventWasCrossed) {
  for_each_adaptive([](const StepperDescription& row) {
    Tossed system;
    double q = 0., v = 1.;
    const auto stepper = row.make(system, {});
    // A step that came all the way would see no sign change.
    for (const double start : {0., 2.})
      EXPECT_EQ(stepper->step(system, start, 2., {&q, 1}, {&v, 1}), Status::ok);
    EXPECT_EQ(system.directions, (std::vector{1, -1})) << row.name;
  });
}

/// Writes down the commits.
class Remembering final : public OneCoordinate {
 public:
  std::vector<double> commits;  ///< times
  Status accelerations(Stage, double, std::span<const double> q, std::span<const double>,
                       std::span<double> a) override {
    a[0] = -25. * q[0];
    return Status::ok;
  }
  void commit(double t, std::span<const double>, std::span<const double>) override {
    commits.push_back(t);
  }
};

TEST(AdaptiveStepper, CommitsAtTheEndOfEachInternalStepButTheLast) {
  for_each_adaptive([](const StepperDescription& row) {
    Remembering system;
    const auto stepper = row.make(system, {});
    double q = 1., v = 0.;
    stepper->step(system, 3., 2., {&q, 1}, {&v, 1});
    ASSERT_EQ(static_cast<double>(system.commits.size()), stepper->statistics().steps - 1.);
    double time = 3.;
    for (const double end : system.commits) {
      EXPECT_GT(end, time);
      time = end;
    }
    EXPECT_LT(time, 5.);
  });
}

/// Two coordinates a group, two groups: a stiff spring between those of one group.
class TwoPairs final : public HybridSystem {
 public:
  std::size_t group = 2;
  std::size_t position_size() const override { return 4; }
  std::size_t velocity_size() const override { return 4; }
  std::size_t jacobian_block() const override { return group; }
  void retract(std::span<const double> q0, std::span<const double> u,
               std::span<double> q) const override {
    for (int i = 0; i < 4; ++i) q[i] = q0[i] + u[i];
  }
  void tangent_rate(std::span<const double>, std::span<const double> v,
                    std::span<double> du) const override {
    std::copy(v.begin(), v.end(), du.begin());
  }
  Status accelerations(Stage, double, std::span<const double> q, std::span<const double> v,
                       std::span<double> a) override {
    for (int i = 0; i < 4; ++i) {
      const int other = i ^ 1;
      a[i] = -1e4 * (q[i] - q[other]) - 100. * (v[i] - v[other]) - q[i];
    }
    return Status::ok;
  }
};

TEST(AdaptiveStepper, TakesABandWhereGroupsAreIndependent) {
  const auto run = [](std::size_t group, Statistics& statistics) {
    TwoPairs pairs;
    pairs.group = group;
    const auto stepper = make_stepper("cvode_bdf", pairs, {1e-8, 1e-10});
    std::array q{1., 0.9, -0.5, -0.4}, v{0., 0., 0., 0.};
    EXPECT_EQ(stepper->step(pairs, 0., 1., q, v), Status::ok);
    statistics = stepper->statistics();
    return q;
  };
  Statistics band, dense;
  const auto q_band = run(2, band), q_dense = run(4, dense);
  for (int i = 0; i < 4; ++i) EXPECT_NEAR(q_band[i], q_dense[i], 1e-6);
  // A banded Jacobian of half bandwidth 3 has 7 groups of columns, a dense one 8 columns.
  EXPECT_LT(band.evaluations - band.jacobians * 7., dense.evaluations - dense.jacobians * 7.);
}

TEST(AdaptiveStepper, IsDrivenBySmallerTolerancesToMoreWork) {
  for_each_adaptive([](const StepperDescription& row) {
    double last = 0.;
    for (const double tolerance : {1e-4, 1e-7, 1e-10}) {
      Pendulum pendulum;
      const auto stepper = row.make(pendulum, {tolerance, tolerance});
      double q = 2., v = 0.;
      stepper->step(pendulum, 0., 3., {&q, 1}, {&v, 1});
      EXPECT_GT(stepper->statistics().evaluations, last) << row.name;
      last = stepper->statistics().evaluations;
    }
  });
}

}  // namespace
}  // namespace hookpoint::integrators
