// Ends of intervals by profiles of functions whose ends are known in closed form.
#include "studies/calibrate/profile.h"

#include <gtest/gtest.h>

#include <cmath>
#include <vector>

namespace hookpoint::studies {
namespace {

constexpr ProfileOptions options{{1e-5, 30, 1e-10}, 1e-2, 24, 0.02};

/// Points whose sum of squares is greater than the optimum's by up to `margin` explain the data.
ProfileProblem problem_of(const ResidualModel& model, const UnitPoint& optimum, double margin) {
  ProfileProblem problem{optimum, model};
  const double least = sum_of_squares(*model(optimum));
  problem.excess = [=](const Residuals& residuals) {
    return (sum_of_squares(residuals) - least) / margin;
  };
  problem.to_squares = [](const Residuals& residuals, const Residuals&) { return residuals; };
  problem.zeros.assign(optimum.size(), std::nullopt);
  return problem;
}

struct Ends {
  ProfileEnd low, high;
};

/// Both ends of a constant from the optimum, where the sum of squares grows by `margin`.
Ends ends_of(const ResidualModel& model, const UnitPoint& optimum, std::size_t constant,
             double margin) {
  const ProfileProblem problem = problem_of(model, optimum, margin);
  return {profile_end(problem, constant, false, options),
          profile_end(problem, constant, true, options)};
}

TEST(Profile, OfALineIsTheIntervalOfItsCovariance) {
  // r_i = 10 (a + b x_i - y_i), x = -1 ... 2: the sum with b refitted grows by
  // 100 n Sxx/(Sxx + n mean^2) (a - a0)^2, with n = 4, mean 0.5, Sxx = 5: by 333.3 (a - a0)^2.
  const ResidualModel line = [](const UnitPoint& point) -> std::optional<Residuals> {
    Residuals residuals;
    for (int i = 0; i < 4; ++i) {
      const double x = i - 1., y = 0.5 + 0.4 * x + (i % 2 == 0 ? 0.01 : -0.01);
      residuals.push_back(10. * (point[0] + point[1] * x - y));
    }
    return residuals;
  };
  const auto start = linearise(line, {0.3, 0.3}, 1e-5);
  ASSERT_TRUE(start);
  UnitPoint optimum = start->point;
  const UnitPoint step = gauss_newton_step(*start);
  for (std::size_t i = 0; i < 2; ++i) optimum[i] += step[i];
  const Ends a = ends_of(line, optimum, 0, 3.);
  const double reach = std::sqrt(3. / (100. * 4. * 5. / 6.));
  EXPECT_NEAR(a.high.share - optimum[0], reach, 1e-6);
  EXPECT_NEAR(optimum[0] - a.low.share, reach, 1e-6);
  EXPECT_FALSE(a.high.better);
}

TEST(Profile, OfAFlatDirectionGoesAsFarAsItIsFlat) {
  // Nothing changes above 0.3; below the residual is 100 (0.3 - x).
  const ResidualModel flat = [](const UnitPoint& point) -> std::optional<Residuals> {
    return Residuals{1., 100. * std::max(0., 0.3 - point[0]), point[1] - 0.5};
  };
  for (const double start : {0.31, 0.5, 0.97}) {
    const Ends ends = ends_of(flat, {start, 0.5}, 0, 4.);
    EXPECT_EQ(ends.high.share, 1.) << start;
    EXPECT_NEAR(ends.low.share, 0.28, 0.01) << start;
    // The other constant's interval is its own.
    EXPECT_NEAR(ends_of(flat, {start, 0.5}, 1, 0.01).high.share, 0.6, 1e-6) << start;
  }
}

TEST(Profile, OfASumThatLevelsOffWithinTheBoundGoesAsFarAsItDoes) {
  // Beside the optimum a parabola that would reach the bound of 1 at a distance of 0.1; from 0.09
  // on it stays at 0.81.
  const ResidualModel levels = [](const UnitPoint& point) -> std::optional<Residuals> {
    return Residuals{1., 10. * std::min(0.09, std::abs(point[0] - 0.3))};
  };
  const Ends ends = ends_of(levels, {0.3}, 0, 1.);
  EXPECT_EQ(ends.high.share, 1.);
  EXPECT_EQ(ends.low.share, 0.);
}

TEST(Profile, OfAStepGoesToTheEdgesOfItsPlateau) {
  // The derivative is 0 wherever it is taken.
  const ResidualModel steps = [](const UnitPoint& point) -> std::optional<Residuals> {
    return Residuals{1., 10. * (std::floor(10. * point[0]) - 4.)};
  };
  const Ends ends = ends_of(steps, {0.43, 0.5}, 0, 4.);
  EXPECT_NEAR(ends.low.share, 0.4, 0.02);
  EXPECT_NEAR(ends.high.share, 0.5, 0.02);
}

TEST(Profile, OfACombinationFollowsTheOtherConstant) {
  // Only the product of both is seen: at (0.5, 0.5) 0.25, so either may be from 0.25 to 1.
  const ResidualModel product = [](const UnitPoint& point) -> std::optional<Residuals> {
    return Residuals{1., 1000. * (point[0] * point[1] - 0.25)};
  };
  for (const std::size_t constant : {0U, 1U}) {
    const Ends ends = ends_of(product, {0.5, 0.5}, constant, 1.);
    EXPECT_NEAR(ends.low.share, 0.25, 0.01);
    EXPECT_GT(ends.high.share, 0.999);
  }
  // A pair that is told apart by little: r = (100 (x + y - 1), 2 (x - y)): moved by d with the
  // other one refitted the sum grows by 16 d^2 and a bit, so to 0.25 by 1.
  const ResidualModel pair = [](const UnitPoint& point) -> std::optional<Residuals> {
    return Residuals{1., 100. * (point[0] + point[1] - 1.), 2. * (point[0] - point[1])};
  };
  const Ends ends = ends_of(pair, {0.5, 0.5}, 0, 1.);
  EXPECT_NEAR(ends.low.share, 0.25, 1e-3);
  EXPECT_NEAR(ends.high.share, 0.75, 1e-3);
}

TEST(Profile, ABetterOptimumAndPlacesWithoutRunsAreReported) {
  const ResidualModel valleys = [](const UnitPoint& point) -> std::optional<Residuals> {
    if (point[0] > 0.9) return std::nullopt;
    return Residuals{1., point[0] < 0.5 ? 1. : 0.};
  };
  const Ends from_worse = ends_of(valleys, {0.3}, 0, 0.5);
  EXPECT_TRUE(from_worse.high.better || from_worse.high.without_runs);
  const auto [low, high] = ends_of(valleys, {0.7}, 0, 0.5);
  EXPECT_TRUE(high.without_runs);
  EXPECT_NEAR(high.share, 0.9, 0.01);
  EXPECT_FALSE(low.without_runs);
  EXPECT_NEAR(low.share, 0.5, 0.01);
}

/// The sum steps at every 0.01 of x y, as where a body lands on whole steps of time.
TEST(Profile, OfACurvedValleyWithRipplesGoesToItsEnds) {
  struct Valley {
    double (*seen)(double, double);
    double low, high;  // where x can be, the other one within its range
  };
  // At (0.5, 0.5): x y = 0.25, x^2 + y^2 = 0.5, x/y = 1, x^2 y^3 = 1/32.
  const std::vector<Valley> valleys{
      {[](double x, double y) { return x * y; }, 0.25, 1.},
      {[](double x, double y) { return x * x + y * y; }, 0., std::sqrt(0.5)},
      {[](double x, double y) { return x / (y + 1e-9); }, 0., 1.},
      {[](double x, double y) { return x * x * y * y * y * 8.; }, std::sqrt(1. / 32.), 1.}};
  for (const Valley& valley : valleys) {
    const ResidualModel rippled = [&](const UnitPoint& point) -> std::optional<Residuals> {
      const double seen = valley.seen(point[0], point[1]);
      const double landed = 0.01 * std::floor(seen / 0.01);
      return Residuals{1., 100. * (seen - valley.seen(0.5, 0.5)),
                       150. * (landed - 0.01 * std::floor(valley.seen(0.5, 0.5) / 0.01))};
    };
    const Ends ends = ends_of(rippled, {0.5, 0.5}, 0, 1.);
    EXPECT_NEAR(ends.low.share, valley.low, 0.02);
    EXPECT_NEAR(ends.high.share, valley.high, 0.02);
  }
}

// cos(8 pi x) has the value of x = 0.3 at 0.05, 0.2, 0.45, 0.55 ... as well.
TEST(Profile, ASeparateValleyIsFound) {
  const ResidualModel periodic = [](const UnitPoint& point) -> std::optional<Residuals> {
    constexpr double turns = 8. * 3.14159265358979323846;
    return Residuals{1., 100. * (std::cos(turns * point[0]) - std::cos(turns * 0.3))};
  };
  const Ends ends = ends_of(periodic, {0.3}, 0, 1.);
  ASSERT_TRUE(ends.high.apart);
  ASSERT_TRUE(ends.low.apart);
  EXPECT_GT((*ends.high.apart)[0], 0.4);
  EXPECT_LT((*ends.low.apart)[0], 0.25);
}

}  // namespace
}  // namespace hookpoint::studies
