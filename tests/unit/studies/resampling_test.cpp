// The bootstrap's samples and the folds of a cross-validation.
#include "studies/calibrate/resampling.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <numeric>
#include <random>

#include "studies/results/statistics.h"
#include "tests/support/normal_noise.h"

namespace hookpoint::studies {
namespace {

TEST(Resampling, ThingsAreDrawnAsOftenAsThereAreOfThem) {
  std::mt19937_64 random(3);
  std::vector<double> never;
  for (int trial = 0; trial < 200; ++trial) {
    const std::vector<int> drawn = draw_with_replacement(50, random);
    EXPECT_EQ(std::accumulate(drawn.begin(), drawn.end(), 0), 50);
    never.push_back(static_cast<double>(std::ranges::count(drawn, 0)) / 50.);
  }
  // Each is missing with the chance (1 - 1/50)^50.
  const double mean = std::accumulate(never.begin(), never.end(), 0.) / 200.;
  EXPECT_NEAR(mean, std::pow(0.98, 50), 0.015);
}

TEST(Resampling, BlocksComeFromTheirOwnCurveWithTheVarianceOfTheNoise) {
  // Residuals of a fit of 2 constants to 40 + 20 samples of noise of size 1 and 10.
  const std::array<std::size_t, 2> sizes{40, 20};
  std::mt19937_64 random(5);
  Residuals residuals;
  for (int i = 0; i < 60; ++i) residuals.push_back((i < 40 ? 1. : 10.) * (i % 2 == 0 ? 1. : -1.));
  double first = 0., second = 0.;
  for (int trial = 0; trial < 100; ++trial) {
    const Residuals shift = shift_of_blocks(residuals, sizes, 3, 2, random);
    for (std::size_t i = 0; i < 60; ++i) {
      const double drawn = residuals[i] + shift[i];
      (i < 40 ? first : second) += drawn * drawn;
    }
  }
  // n/(n - constants), of either curve.
  EXPECT_NEAR(first / 4000., 60. / 58., 1e-9);
  EXPECT_NEAR(second / 2000., 100. * 60. / 58., 1e-9);
}

TEST(Resampling, BlocksGrowWithWhatHangsTogether) {
  std::mt19937_64 random(9);
  const std::array<std::size_t, 1> sizes{216};
  Residuals white, slow;
  for (int i = 0; i < 216; ++i) {
    const double part = static_cast<double>(random() >> 11) * 0x1p-53 - 0.5;
    white.push_back(part);
    slow.push_back(std::sin(0.05 * i));
  }
  EXPECT_EQ(block_length(white, sizes), 6U);
  EXPECT_GT(block_length(slow, sizes), 30U);
  EXPECT_LE(block_length(slow, sizes), 54U);
}

TEST(Resampling, IntervalsHoldTheTruthInNineteenOfTwentyCases) {
  // Slopes of straight lines through 60 samples of noise alone.
  constexpr std::size_t samples = 60, resamples = 100;
  constexpr int lines = 1000;
  const std::array<std::size_t, 1> sizes{samples};
  std::vector<double> x;
  double squares = 0.;
  for (std::size_t i = 0; i < samples; ++i) {
    x.push_back(static_cast<double>(i) - 29.5);
    squares += x.back() * x.back();
  }
  const auto slope_of = [&](const Residuals& y) {
    return std::inner_product(x.begin(), x.end(), y.begin(), 0.) / squares;
  };
  std::mt19937_64 random(11);
  int inside = 0;
  for (int line = 0; line < lines; ++line) {
    Residuals data(samples);
    for (double& one : data) one = testing::normal_number(random);
    const double slope = slope_of(data);  // the true one is 0
    const double mean = std::accumulate(data.begin(), data.end(), 0.) / samples;
    Residuals rest(samples);
    for (std::size_t i = 0; i < samples; ++i) rest[i] = data[i] - mean - slope * x[i];
    const std::size_t block = block_length(rest, sizes);
    std::vector<double> slopes;
    for (std::size_t i = 0; i < resamples; ++i) {
      Residuals drawn = shift_of_blocks(rest, sizes, block, 2, random);
      for (std::size_t j = 0; j < samples; ++j) drawn[j] += rest[j];
      slopes.push_back(slope + slope_of(drawn));
    }
    const double tail =
        tail_of_interval(static_cast<double>(samples) / static_cast<double>(block) - 2.);
    inside += quantile(slopes, tail) <= 0. && 0. <= quantile(slopes, 1. - tail) ? 1 : 0;
  }
  EXPECT_NEAR(static_cast<double>(inside) / lines, 0.95, 0.015);
}

TEST(Resampling, CorrelatedResidualsAreWorthFewerIndependentOnes) {
  // x_i = a x_(i-1) + e_i: its autocorrelation is a^lag, and 1 + 2 sum a^lag = (1 + a)/(1 - a).
  const std::array<std::size_t, 1> sizes{40000};
  std::mt19937_64 random(13);
  for (const double a : {0., 0.5, 0.8}) {
    Residuals residuals;
    double last = 0.;
    for (std::size_t i = 0; i < sizes[0]; ++i)
      residuals.push_back(last = a * last + testing::normal_number(random));
    const double expected = (1. + a) / (1. - a);
    EXPECT_NEAR(statistical_inefficiency(residuals, sizes), expected, 0.1 * expected) << a;
  }
  // Never less than 1, nor of what is too short.
  Residuals alternating;
  for (int i = 0; i < 40; ++i) alternating.push_back(i % 2 == 0 ? 1. : -1.);
  const std::array<std::size_t, 2> parts{36, 4};
  EXPECT_EQ(statistical_inefficiency(alternating, parts), 1.);
}

TEST(Resampling, FoldsAreEquallyLargeAndDrawnBySeed) {
  const auto folds = fold_of_each(23, 5, 1);
  for (std::size_t fold = 0; fold < 5; ++fold) {
    const auto size = std::ranges::count(folds, fold);
    EXPECT_TRUE(size == 4 || size == 5) << size;
  }
  EXPECT_EQ(folds, fold_of_each(23, 5, 1));
  EXPECT_NE(folds, fold_of_each(23, 5, 2));
}

TEST(Resampling, AnIntervalOfFewThingsHasNarrowerTails) {
  // Of ever more things the normal distribution's. Of 11 Student's t with 10 degrees of freedom,
  // 2.228, and Phi(-2.228 sqrt(1.1)) = Phi(-2.3367) = 0.00972 (tables: Abramowitz & Stegun 26.10,
  // 26.1).
  EXPECT_NEAR(tail_of_interval(1e7), 0.025, 1e-6);
  EXPECT_NEAR(tail_of_interval(11.), 0.00972, 1e-5);
  EXPECT_LT(tail_of_interval(5.), tail_of_interval(6.));
}

TEST(Statistics, MeansAndTheirIntervals) {
  const std::array values{1., 2., 3., 4., 5.};
  EXPECT_EQ(mean(values), 3.);
  EXPECT_EQ(mean_by_fours(values), 3.);
  // Variance 10/4, and t = 2.776 of 4 degrees of freedom (Abramowitz & Stegun, table 26.10).
  EXPECT_NEAR(standard_error(values), std::sqrt(2.5 / 5.), 1e-15);
  EXPECT_NEAR(student_quantile(5.), 2.776, 5e-4);
  EXPECT_NEAR(mean_interval(values)->half_width, 2.776 * std::sqrt(0.5), 5e-4);
  const std::array one{7.};
  EXPECT_EQ(standard_error(one), 0.);
  EXPECT_FALSE(mean_interval(one));
  // One degree of freedom at least: 12.706.
  EXPECT_NEAR(student_quantile(1.), 12.706, 5e-4);
}

TEST(Statistics, QuantilesAndCorrelations) {
  EXPECT_DOUBLE_EQ(quantile({4., 1., 3., 2., 5.}, 0.5), 3.);
  EXPECT_DOUBLE_EQ(quantile({4., 1., 3., 2., 5.}, 0.25), 1.5);
  EXPECT_DOUBLE_EQ(quantile({4., 1., 3., 2., 5.}, 0.01), 1.);
  const std::array one{1., 2., 3.}, other{-2., -4., -6.}, same{7., 7., 7.};
  EXPECT_NEAR(correlation(one, other), -1., 1e-12);
  EXPECT_EQ(correlation(one, same), 0.);
}

}  // namespace
}  // namespace hookpoint::studies
