// Least squares against NIST's certified problems (Statistical Reference Datasets, nonlinear
// regression, https://www.itl.nist.gov/div898/strd/nls/nls_main.shtml): solutions to 11 digits.
#include "studies/calibrate/least_squares.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>

namespace hookpoint::studies {
namespace {

struct Certified {
  double value, deviation;
};

/// A constant's range; logarithmic, as its sign is known.
struct Range {
  double from, to;
  double at(double share) const { return from * std::pow(to / from, share); }
};

struct Problem {
  const char* name;
  double (*model)(double x, const std::vector<double>& b);
  std::vector<double> x, y;
  std::vector<Range> ranges;
  std::vector<Certified> certified;
  double sum;

  std::vector<double> constants(const UnitPoint& shares) const {
    std::vector<double> b;
    for (std::size_t i = 0; i < shares.size(); ++i) b.push_back(ranges[i].at(shares[i]));
    return b;
  }
  ResidualModel residuals() const {
    return [this](const UnitPoint& shares) -> std::optional<Residuals> {
      Residuals all;
      for (std::size_t i = 0; i < x.size(); ++i)
        all.push_back(model(x[i], constants(shares)) - y[i]);
      return all;
    };
  }
};

const std::vector<Problem>& problems() {
  static const std::vector<Problem> all{
      {"Misra1a",
       [](double x, const std::vector<double>& b) { return b[0] * (1. - std::exp(-b[1] * x)); },
       {77.6, 114.9, 141.1, 190.8, 239.9, 289.0, 332.8, 378.4, 434.8, 477.3, 536.8, 593.1, 689.1,
        760.0},
       {10.07, 14.73, 17.94, 23.93, 29.61, 35.18, 40.02, 44.82, 50.76, 55.05, 61.01, 66.40, 75.47,
        81.78},
       {{1e2, 1e3}, {1e-5, 1e-2}},
       {{2.3894212918e2, 2.7070075241}, {5.5015643181e-4, 7.2668688436e-6}},
       1.2455138894e-1},
      {"DanWood",
       [](double x, const std::vector<double>& b) { return b[0] * std::pow(x, b[1]); },
       {1.309, 1.471, 1.490, 1.565, 1.611, 1.680},
       {2.138, 3.421, 3.597, 4.340, 4.882, 5.660},
       {{1e-2, 1e1}, {1e-1, 1e1}},
       {{7.6886226176e-1, 1.8281973860e-2}, {3.8604055871, 5.1726610913e-2}},
       4.3173084083e-3},
      {"BoxBOD",
       [](double x, const std::vector<double>& b) { return b[0] * (1. - std::exp(-b[1] * x)); },
       {1., 2., 3., 5., 7., 10.},
       {109., 149., 149., 191., 213., 224.},
       {{1e1, 1e3}, {1e-2, 1e1}},
       {{2.1380940889e2, 1.2354515176e1}, {5.4723748542e-1, 1.0455993237e-1}},
       1.1680088766e3},
      {"Rat42",
       [](double x, const std::vector<double>& b) {
         return b[0] / (1. + std::exp(b[1] - b[2] * x));
       },
       {9., 14., 21., 28., 42., 57., 63., 70., 79.},
       {8.930, 10.800, 18.590, 22.330, 39.350, 56.110, 61.730, 64.620, 67.080},
       {{1e1, 1e3}, {1e-1, 1e1}, {1e-3, 1.}},
       {{7.2462237576e1, 1.7340283401},
        {2.6180768402, 8.8295217536e-2},
        {6.7359200066e-2, 3.4465663377e-3}},
       8.0565229338}};
  return all;
}

TEST(LeastSquares, CertifiedProblemsFromStartsAllOverTheirRanges) {
  for (const Problem& problem : problems()) {
    SCOPED_TRACE(problem.name);
    const ResidualModel model = problem.residuals();
    std::optional<LeastSquaresFit> best;
    for (const UnitPoint& start : spread_starts(problem.ranges.size(), {}, 8, 1)) {
      const auto fit = refine(model, start, {});
      ASSERT_TRUE(fit);
      if (!best || fit->sum < best->sum) best = fit;
    }
    EXPECT_NEAR(best->sum / problem.sum, 1., 1e-9);
    const std::vector<double> found = problem.constants(best->point);
    for (std::size_t i = 0; i < found.size(); ++i)
      EXPECT_NEAR(found[i] / problem.certified[i].value, 1., 1e-6) << i;
  }
}

TEST(LeastSquares, DeviationsOfTheCertifiedProblems) {
  for (const Problem& problem : problems()) {
    SCOPED_TRACE(problem.name);
    UnitPoint point;
    for (std::size_t i = 0; i < problem.ranges.size(); ++i)
      point.push_back(std::log(problem.certified[i].value / problem.ranges[i].from) /
                      std::log(problem.ranges[i].to / problem.ranges[i].from));
    const auto fit = linearise(problem.residuals(), point, 1e-5);
    ASSERT_TRUE(fit);
    const auto covariances = covariance(*fit);
    ASSERT_TRUE(covariances);
    for (std::size_t i = 0; i < point.size(); ++i) {
      // d value = value ln(to/from) d share
      const Range& range = problem.ranges[i];
      const double slope = problem.certified[i].value * std::log(range.to / range.from);
      EXPECT_NEAR(slope * std::sqrt((*covariances)[i][i]) / problem.certified[i].deviation, 1.,
                  1e-5);
    }
  }
}

TEST(LeastSquares, AnOptimumOutsideTheBoxEndsAtItsEdge) {
  // 0.3 - 2 share is least at share = 1, 5 share at share = 0.
  const ResidualModel model = [](const UnitPoint& at) -> std::optional<Residuals> {
    return Residuals{at[0] - 1.5, 5. * at[1] + 1.};
  };
  const auto fit = refine(model, UnitPoint{0.4, 0.6}, {});
  ASSERT_TRUE(fit);
  EXPECT_NEAR(fit->point[0], 1., 1e-6);
  EXPECT_NEAR(fit->point[1], 0., 1e-6);
}

TEST(LeastSquares, GoesAroundPlacesWithoutResiduals) {
  // Nothing beyond 0.7, and from 0.1 a full step would land there.
  const ResidualModel model = [](const UnitPoint& at) -> std::optional<Residuals> {
    if (at[0] > 0.7) return std::nullopt;
    return Residuals{std::exp(3. * at[0]) - std::exp(1.8), 0.1};
  };
  const auto fit = refine(model, UnitPoint{0.1}, {});
  ASSERT_TRUE(fit);
  EXPECT_NEAR(fit->point[0], 0.6, 1e-7);
  EXPECT_FALSE(refine(model, UnitPoint{0.9}, {}));
}

TEST(LeastSquares, AConstantThatChangesNothingHasNoCovariance) {
  const ResidualModel model = [](const UnitPoint& at) -> std::optional<Residuals> {
    return Residuals{at[0] - 0.3, 2. * at[0] - 0.5, 1. - at[0]};
  };
  const auto fit = linearise(model, UnitPoint{0.3, 0.5}, 1e-5);
  ASSERT_TRUE(fit);
  EXPECT_FALSE(covariance(*fit));
  // It stays; the other one goes where it goes alone: (0.3 + 2 * 0.5 + 1)/(1 + 4 + 1).
  const UnitPoint step = gauss_newton_step(*fit);
  EXPECT_NEAR(0.3 + step[0], 2.3 / 6., 1e-9);
  EXPECT_EQ(step[1], 0.);
  const LinearProfile linear = linear_profile(*fit, 0);
  EXPECT_NEAR(linear.curvature, 6., 1e-6);
  EXPECT_EQ(linear.others[1], 0.);
  EXPECT_EQ(linear_profile(*fit, 1).curvature, 0.);
}

TEST(LeastSquares, OneStepSolvesALinearProblem) {
  const ResidualModel model = [](const UnitPoint& at) -> std::optional<Residuals> {
    return Residuals{at[0] + at[1] - 0.9, at[0] - at[1] - 0.3, 2. * at[0] - 1.2};
  };
  const auto start = linearise(model, UnitPoint{0.5, 0.5}, 1e-3);
  const UnitPoint step = gauss_newton_step(*start);
  EXPECT_NEAR(0.5 + step[0], 0.6, 1e-12);
  EXPECT_NEAR(0.5 + step[1], 0.3, 1e-12);
}

TEST(LeastSquares, StartsFillTheBoxEvenlyAndAreTheSameEveryTime) {
  const auto starts = spread_starts(2, {{0.25, 0.75}}, 64, 7);
  ASSERT_EQ(starts.size(), 65U);
  EXPECT_EQ(starts.front(), (UnitPoint{0.25, 0.75}));
  EXPECT_EQ(starts, spread_starts(2, {{0.25, 0.75}}, 64, 7));
  EXPECT_NE(starts.back(), spread_starts(2, {}, 64, 8).back());
  // Of 64 points every sixteenth part of the square has some.
  for (int row = 0; row < 4; ++row)
    for (int column = 0; column < 4; ++column)
      EXPECT_GE(std::ranges::count_if(starts,
                                      [&](const UnitPoint& at) {
                                        return static_cast<int>(4. * at[0]) == column &&
                                               static_cast<int>(4. * at[1]) == row;
                                      }),
                2);
}

}  // namespace
}  // namespace hookpoint::studies
