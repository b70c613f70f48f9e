// What an Expect makes of a port, and what it says to a wrong one.
#include "simulation/run/expectation.h"

#include <gtest/gtest.h>

#include <cmath>
#include <optional>
#include <string>

#include "tests/support/load_text.h"

namespace hookpoint {
namespace {

using simulation::ExpectationSpec;
using simulation::Reducer;
using simulation::Reduction;

ExpectationSpec take(Reduction reduction, double from = 0., std::optional<double> to = {},
                     double level = 0.) {
  ExpectationSpec spec;
  spec.reduction.take = reduction;
  spec.reduction.from = from;
  spec.reduction.to = to;
  spec.reduction.level = level;
  return spec;
}

/// 3, 1, 4, 1, 5 at 0, 1, 2, 3, 4 s.
std::optional<double> of_pi(const ExpectationSpec& spec) {
  Reducer reducer(spec.reduction);
  double time = 0.;
  for (const double value : {3., 1., 4., 1., 5.}) reducer.observe(time++, value);
  return reducer.value();
}

TEST(Reducer, TakesEachNumberOfASeries) {
  EXPECT_EQ(of_pi(take(Reduction::final)), 5.);
  EXPECT_EQ(of_pi(take(Reduction::maximum)), 5.);
  EXPECT_EQ(of_pi(take(Reduction::minimum)), 1.);
  EXPECT_EQ(of_pi(take(Reduction::range)), 4.);
  EXPECT_EQ(of_pi(take(Reduction::change)), 2.);
  EXPECT_NEAR(*of_pi(take(Reduction::mean)), 14. / 5., 1e-15);
  EXPECT_NEAR(*of_pi(take(Reduction::rms)), std::sqrt(52. / 5.), 1e-15);
  // sum (t - 2)(y - 2.8)/sum (t - 2)^2 = (-2*3 - 1*1 + 0 + 1*1 + 2*5)/10
  EXPECT_NEAR(*of_pi(take(Reduction::slope)), 0.4, 1e-15);
}

// A parabola's own second derivative, far from the start of time and on a large constant.
TEST(Reducer, FitsTheCurvatureOfAParabola) {
  Reducer curvature(take(Reduction::curvature, 0.5).reduction);
  for (int step = 0; step <= 2000; ++step) {
    const double t = 1e-3 * step;
    curvature.observe(t, 1e3 - 3. * t + 0.5 * 0.0876 * t * t);
  }
  EXPECT_NEAR(*curvature.value(), 0.0876, 1e-9);
  // (1, 3, 2) and so on against the polynomials orthogonal on five points: 2 (2, -1, -2, -1, 2).y/14
  EXPECT_NEAR(*of_pi(take(Reduction::curvature)), 2. * (6. - 1. - 8. - 1. + 10.) / 14., 1e-14);
  EXPECT_EQ(of_pi(take(Reduction::curvature, 3.)), std::nullopt) << "two values have none";
}

TEST(ExpectationResult, CountsDecadesOfItsScale) {
  ExpectationSpec spec;
  spec.expected = -2.;
  using Result = simulation::ExpectationResult;
  EXPECT_NEAR(*(Result{&spec, -2.002}.decades()), -3., 1e-9);
  EXPECT_EQ((Result{&spec, -2.}.decades()), -9.);
  EXPECT_EQ((Result{&spec, {}}.decades()), std::nullopt);
  spec.scale = 200.;
  EXPECT_NEAR(*(Result{&spec, 0.}.decades()), -2., 1e-12);
  spec = {};
  EXPECT_EQ((Result{&spec, 1.}.decades()), std::nullopt) << "0 without a scale";
}

TEST(Reducer, SeesOnlyItsWindowEndsIncluded) {
  EXPECT_EQ(of_pi(take(Reduction::maximum, 1., 3.)), 4.);
  EXPECT_EQ(of_pi(take(Reduction::final, 1., 3.)), 1.);
  EXPECT_EQ(of_pi(take(Reduction::change, 2., 4.)), 1.);
  EXPECT_NEAR(*of_pi(take(Reduction::mean, 1., 3.)), 2., 1e-15);
  EXPECT_EQ(of_pi(take(Reduction::final, 5.)), std::nullopt);
  EXPECT_EQ(of_pi(take(Reduction::slope, 4.)), std::nullopt) << "one value has no slope";
}

TEST(Reducer, FindsTheFirstCrossingOnAStraightLine) {
  EXPECT_NEAR(*of_pi(take(Reduction::time_at, 0., {}, 2.)), 0.5, 1e-15);
  EXPECT_NEAR(*of_pi(take(Reduction::time_at, 1., {}, 2.)), 1. + 1. / 3., 1e-15);
  EXPECT_EQ(of_pi(take(Reduction::time_at, 0., {}, 4.)), 2.) << "met at a step";
  EXPECT_EQ(of_pi(take(Reduction::time_at, 0., {}, 3.)), 0.) << "met at the start";
  EXPECT_EQ(of_pi(take(Reduction::time_at, 0., {}, 6.)), std::nullopt) << "never met";
  EXPECT_EQ(of_pi(take(Reduction::time_at, 0., 3., 4.5)), std::nullopt) << "met after the window";
}

TEST(Reducer, TakesTimesAndAreasOfTheStraightLinesBetweenSteps) {
  EXPECT_EQ(of_pi(take(Reduction::last)), 5.);
  EXPECT_EQ(of_pi(take(Reduction::time_of_maximum)), 4.);
  EXPECT_EQ(of_pi(take(Reduction::time_of_minimum)), 1.) << "the first of two";
  EXPECT_NEAR(*of_pi(take(Reduction::integral)), 2. + 2.5 + 2.5 + 3., 1e-15);
  // Above 2: until 0.5 s, from 4/3 to 8/3 s, and from 3.25 s on.
  EXPECT_EQ(of_pi(take(Reduction::count_above, 0., {}, 2.)), 3.);
  EXPECT_NEAR(*of_pi(take(Reduction::time_above, 0., {}, 2.)), 0.5 + 4. / 3. + 0.75, 1e-15);
  EXPECT_EQ(of_pi(take(Reduction::count_above, 0., {}, 9.)), 0.);
}

// x = exp(-t): within b of its end e from t = -log(e + b) on; about 0 from -log(b) on.
TEST(Reducer, SettlesWhenNothingLeavesTheBandAgain) {
  constexpr double dt = 1e-3, band = 0.01;
  ExpectationSpec spec = take(Reduction::settle_time);
  spec.reduction.level.reset();
  spec.reduction.band = band;
  Reducer about_end(spec.reduction);
  spec.reduction.level = 0.;
  Reducer about_zero(spec.reduction);
  spec.reduction.band = 0.005;
  Reducer not_yet(spec.reduction);
  for (int k = 0; k <= 5000; ++k)
    for (Reducer* reducer : {&about_end, &about_zero, &not_yet})
      reducer->observe(k * dt, std::exp(-k * dt));
  // To a hundredth of the band, 1e-4/0.0167 of a second here.
  EXPECT_NEAR(*about_end.value(), -std::log(std::exp(-5.) + band), 7e-3);
  EXPECT_NEAR(*about_zero.value(), -std::log(band), dt);
  EXPECT_EQ(not_yet.value(), std::nullopt) << "exp(-5) is above 0.005";
  // A ringing end counts from its last excursion on, whichever side that was on.
  Reducer rings([] {
    ExpectationSpec ringing = take(Reduction::settle_time);
    ringing.reduction.level.reset();
    ringing.reduction.band = 0.5;
    return ringing.reduction;
  }());
  double time = 0.;
  for (const double value : {0., 2., 0.2, -0.7, 0.1, 0.3, 0.}) rings.observe(time++, value);
  EXPECT_EQ(rings.value(), 4.);
}

// Sums of squares of such times and values would leave nothing of the rise.
TEST(Reducer, KeepsTheSlopeOfASmallRiseFarFromZero) {
  Reducer slope(take(Reduction::slope).reduction);
  for (int k = 0; k < 1000; ++k) {
    const double t = 1e7 + 1e-3 * k;
    slope.observe(t, 1e6 + 1e-3 * (t - 1e7));
  }
  EXPECT_NEAR(*slope.value(), 1e-3, 1e-8);
}

TEST(ExpectationResult, HoldsWithinEitherBound) {
  ExpectationSpec spec;
  spec.expected = 10.;
  spec.tolerance = 0.01;
  EXPECT_TRUE((simulation::ExpectationResult{&spec, 10.099}.ok()));
  EXPECT_FALSE((simulation::ExpectationResult{&spec, 10.101}.ok()));
  EXPECT_FALSE((simulation::ExpectationResult{&spec, {}}.ok())) << "nothing was measured";
  EXPECT_FALSE((simulation::ExpectationResult{&spec, std::nan("")}.ok()));
  EXPECT_NEAR(*(simulation::ExpectationResult{&spec, 9.95}.error()), 0.005, 1e-15);
  spec.within = 0.2;
  EXPECT_TRUE((simulation::ExpectationResult{&spec, 10.15}.ok()));
}

TEST(Expect, CoversTheLawsThatItNames) {
  ExpectationSpec spec;
  EXPECT_TRUE(spec.covers("lugre", "rk4"));
  spec.laws = {"hookpoint", "nominal"};
  spec.integrators = {"rk4"};
  EXPECT_TRUE(spec.covers("nominal", "rk4"));
  EXPECT_FALSE(spec.covers("lugre", "rk4"));
  EXPECT_FALSE(spec.covers("nominal", "cvode"));
  spec.laws = {};
  spec.except_laws = {"lugre"};
  EXPECT_FALSE(spec.covers("lugre", "rk4"));
}

TEST(Expect, SaysNothingOfAPeerWhereItNamesLawsOrIntegrators) {
  ExpectationSpec spec;
  simulation::Experiment experiment;
  spec.integrators = {experiment.integrator};
  EXPECT_TRUE(spec.covers(experiment));
  experiment.engine = "ode";
  EXPECT_FALSE(spec.covers(experiment));
  spec.integrators = {};
  EXPECT_TRUE(spec.covers(experiment));
}

struct Wrong {
  const char* name;
  const char* fields;  ///< of the Expect, on line 2
  const char* message;
};

class WrongExpect : public ::testing::TestWithParam<Wrong> {};

TEST_P(WrongExpect, IsToldWhatIsWrong) {
  const Loaded loaded = load_text(
      "World w { gravity = 0; Robot b { Base.mobile { mass = 1; Shape.Box dimensions = 1, 1, 1; } "
      "} }\nExpect e { " +
      std::string(GetParam().fields) + " }\n");
  EXPECT_FALSE(loaded.experiment);
  EXPECT_EQ(loaded.diagnostics, GetParam().message);
}

INSTANTIATE_TEST_SUITE_P(
    All, WrongExpect,
    ::testing::Values(
        Wrong{"unit", "of = w.b.position.x; equals = 2 s; within = 1 m;",
              "error 2:42 `equals` is to be in m, not in s\n"},
        Wrong{"unit_of_a_slope", "of = w.b.position.x; take = slope; equals = 2 m; within = 1 m/s;",
              "error 2:56 `equals` is to be in m/s, not in m\n"},
        Wrong{"unit_of_within", "of = w.b.position.x; equals = 2 m; within = 1 s;",
              "error 2:56 `within` is to be in m, not in s\n"},
        Wrong{"law", "of = w.b.position.x; equals = 2 m; within = 1 m; laws = hookpiont;",
              "error 2:68 there is no `hookpiont` among the laws; did you mean `hookpoint`?\n"},
        Wrong{"integrator", "of = w.b.position.x; equals = 2 m; within = 1 m; integrators = rk5;",
              "error 2:75 there is no `rk5` among the integrators; did you mean `rk4`?\n"},
        Wrong{"level", "of = w.b.position.x; take = time_at; equals = 2 s; within = 1 s;",
              "error 2:40 `time_at` needs the `level` that is meant\n"},
        Wrong{"tolerance", "of = w.b.position.x; equals = 2 m;",
              "error 2:1 no difference is allowed: give a `tolerance` (relative) or `within`\n"},
        Wrong{"window", "of = w.b.position.x; equals = 2 m; within = 1 m; from = 2 s; to = 1 s;",
              "error 2:78 `to` must be later than `from`\n"},
        Wrong{"port", "of = w.b.positoin.x; equals = 2 m; within = 1 m;",
              "error 2:17 `w.b.positoin.x`: `b` (Robot) has no object or port `positoin`; did you "
              "mean `position`?\n"}),
    [](const auto& wrong) { return wrong.param.name; });

}  // namespace
}  // namespace hookpoint
