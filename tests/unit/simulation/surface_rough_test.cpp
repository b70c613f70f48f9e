// Random ground against its definition: amplitude, mean, the ring of its spectrum, slope, seeds and
// bytes.
#include <gtest/gtest.h>

#include <array>
#include <bit>
#include <cmath>
#include <complex>
#include <numbers>

#include "simulation/scene/terrain/surface.h"

namespace hookpoint::simulation {
namespace {

constexpr double pi = std::numbers::pi;

RoughGround rough(std::uint64_t seed) {
  RoughGround ground;
  ground.amplitude = 0.05;
  ground.wavelength = 0.4;
  ground.seed = seed;
  return ground;
}

double largest(const std::vector<double>& heights) {
  double result = 0.;
  for (const double height : heights) result = std::max(result, std::abs(height));
  return result;
}

double mean(const std::vector<double>& values) {
  double sum = 0.;
  for (const double value : values) sum += value;
  return sum / static_cast<double>(values.size());
}

double mean_square(const std::vector<double>& values) {
  double sum = 0.;
  for (const double value : values) sum += value * value;
  return sum / static_cast<double>(values.size());
}

/// FNV-1a of the heights' bits, least significant byte first.
std::uint64_t hash_of(const GridSpec& grid) {
  std::uint64_t hash = 0xcbf29ce484222325u;
  for (const double height : grid.heights) {
    const auto bits = std::bit_cast<std::uint64_t>(height);
    for (int shift = 0; shift < 64; shift += 8)
      hash = (hash ^ (bits >> shift & 0xff)) * 0x100000001b3u;
  }
  return hash;
}

TEST(RoughSurface, IsAsHighAsItsAmplitudeAboutZero) {
  for (const double flat_radius : {0., 0.7}) {
    for (const std::uint64_t seed : {1, 2, 3, 4}) {
      RoughGround ground = rough(seed);
      ground.flat_radius = flat_radius;
      const GridSpec grid = rough_surface(ground, {0.05, 4., 3.});
      ASSERT_EQ(grid.columns, 81);
      ASSERT_EQ(grid.rows, 61);
      EXPECT_EQ(grid.origin_x, -2.);
      EXPECT_EQ(grid.origin_y, -1.5);
      EXPECT_NEAR(largest(grid.heights), 0.05, 1e-17);
      EXPECT_NEAR(mean(grid.heights), 0., 1e-16);
    }
  }
}

// A sum of 64 waves with phases of their own is close to normal: kurtosis 3 - 3/128, and the
// largest of thousands of heights is 3 to 5 times their rms.
TEST(RoughSurface, HeightsAreNearlyNormal) {
  double fourth = 0., square = 0.;
  for (std::uint64_t seed = 1; seed <= 8; ++seed) {
    const GridSpec grid = rough_surface(rough(seed), {0.1, 16., 16.});
    const double variance = mean_square(grid.heights);
    EXPECT_GT(0.05 / std::sqrt(variance), 3.) << seed;
    EXPECT_LT(0.05 / std::sqrt(variance), 5.5) << seed;
    for (const double height : grid.heights)
      fourth += height * height * height * height / (variance * variance);
    square += static_cast<double>(grid.heights.size());
  }
  EXPECT_NEAR(fourth / square, 3., 0.15);
}

/// |sum w_i w_j h_ij exp(-i(k_x x + k_y y))|^2 for k = 2 pi (m, n)/length, m and n from -side to
/// side: by rows, then by columns. The Hann window w lets a wave leak to its next two neighbours
/// only.
std::vector<double> power_spectrum(const GridSpec& grid, int side) {
  const int count = grid.columns - 1;
  const auto window = [&](int i) { return 0.5 - 0.5 * std::cos(2. * pi * i / count); };
  const auto turn = [&](int m, int i) { return std::polar(1., -2. * pi * m * i / count); };
  const int width = 2 * side + 1;
  std::vector<std::complex<double>> rows(static_cast<std::size_t>(count * width));
  for (int row = 0; row < count; ++row)
    for (int m = -side; m <= side; ++m)
      for (int i = 0; i < count; ++i)
        rows[row * width + m + side] +=
            window(i) * grid.heights[row * grid.columns + i] * turn(m, i);
  std::vector<double> power;
  for (int n = -side; n <= side; ++n)
    for (int m = -side; m <= side; ++m) {
      std::complex<double> sum;
      for (int row = 0; row < count; ++row)
        sum += window(row) * rows[row * width + m + side] * turn(n, row);
      power.push_back(std::norm(sum));
    }
  return power;
}

// Power stands on the ring from k/sqrt(2) to sqrt(2) k, with equal areas of it alike.
TEST(RoughSurface, SpectrumIsFlatOnItsRingAndZeroOffIt) {
  constexpr double length = 6.4;  // 16 wavelengths: the ring is from 11.3 to 22.6 cycles
  constexpr int side = 30;
  const double inner = 16. / std::numbers::sqrt2, outer = 16. * std::numbers::sqrt2;
  double inside = 0., outside = 0.;
  std::array<double, 3> thirds{}, sixths_of_turn{};
  for (std::uint64_t seed = 1; seed <= 12; ++seed) {
    const GridSpec grid = rough_surface(rough(seed), {0.1, length, length});
    const std::vector<double> power = power_spectrum(grid, side);
    for (int n = -side; n <= side; ++n)
      for (int m = -side; m <= side; ++m) {
        const double k = std::hypot(m, n);
        const double p = power[(n + side) * (2 * side + 1) + m + side];
        const double leak = 1.5;  // the window's, in cycles
        (k > inner - leak && k < outer + leak ? inside : outside) += p;
        const double area = (k * k - inner * inner) / (outer * outer - inner * inner);
        if (area >= 0. && area < 1.) thirds[static_cast<std::size_t>(3. * area)] += p;
        const double turn = std::atan2(n, m) / pi + 1.;  // 0 to 2 once around
        sixths_of_turn[static_cast<std::size_t>(3. * turn) % 3] += p;
      }
  }
  EXPECT_LT(outside / inside, 2e-3);
  for (const double third : thirds)
    EXPECT_NEAR(third / (thirds[0] + thirds[1] + thirds[2]), 1. / 3., 0.06);
  for (const double part : sixths_of_turn) EXPECT_NEAR(part / (inside + outside), 1. / 3., 0.02);
}

// The mean of |k|^2 over the ring is 5/4 k^2, and so the rms slope is sqrt(5/4) k times the rms
// height; on cells s wide a wave's slope is less by sin(k s/2)/(k s/2), 0.7 % here.
TEST(RoughSurface, SlopeFollowsFromTheBand) {
  const double k = 2. * pi / 0.4;
  for (std::uint64_t seed = 1; seed <= 4; ++seed) {
    const double spacing = 0.02;
    const GridSpec grid = rough_surface(rough(seed), {spacing, 12., 12.});
    std::vector<double> slopes_squared;
    double steepest = 0., sharpest = 0.;
    for (int row = 0; row + 1 < grid.rows; ++row)
      for (int column = 1; column + 1 < grid.columns; ++column) {
        const double* h = &grid.heights[row * grid.columns + column];
        const double along_x = (h[1] - h[0]) / spacing,
                     along_y = (h[grid.columns] - h[0]) / spacing;
        slopes_squared.push_back(along_x * along_x + along_y * along_y);
        steepest = std::max(steepest, std::hypot(along_x, along_y));
        sharpest = std::max(sharpest, std::abs(h[1] - 2. * h[0] + h[-1]));
      }
    const double rms = std::sqrt(mean_square(grid.heights));
    EXPECT_NEAR(std::sqrt(mean(slopes_squared)) / (rms * k * std::sqrt(1.25)), 1., 0.06) << seed;
    // Bernstein: a function without waves shorter than 2 pi/K has |h'| <= K max|h|, |h''| <= K^2
    // max|h|. The largest height elsewhere is not above that on this ground by a tenth.
    const double K = std::numbers::sqrt2 * k, height = 1.1 * 0.05;
    EXPECT_LT(steepest, K * height) << seed;
    EXPECT_LT(sharpest, K * K * height * spacing * spacing) << seed;
  }
}

TEST(RoughSurface, IsPlaneWhereARobotStartsAndRoughBeyond) {
  RoughGround ground = rough(5);
  ground.flat_radius = 0.6;
  ground.slope = 0.2;
  ground.azimuth = 0.7;
  const GridSpec grid = rough_surface(ground, {0.05, 4., 4.});
  const auto over_plane = [&](int column, int row) {
    const double x = -2. + 0.05 * column, y = -2. + 0.05 * row;
    return std::pair{std::hypot(x, y), grid.heights[row * grid.columns + column] +
                                           std::tan(0.2) * (x * std::cos(0.7) + y * std::sin(0.7))};
  };
  std::vector<double> beyond;
  for (int row = 0; row < grid.rows; ++row)
    for (int column = 0; column < grid.columns; ++column) {
      const auto [radius, height] = over_plane(column, row);
      if (radius <= 0.6) {
        EXPECT_NEAR(height, 0., 1e-15);
      }
      if (radius > 1.) beyond.push_back(height);
    }
  EXPECT_NEAR(largest(beyond), 0.05, 1e-15);
  EXPECT_GT(std::sqrt(mean_square(beyond)), 0.05 / 5.5);
}

TEST(RoughSurface, ASeedIsAGround) {
  const Extent extent{0.05, 2., 2.};
  EXPECT_EQ(rough_surface(rough(1), extent).heights, rough_surface(rough(1), extent).heights);
  // Two seeds' heights are strangers: their correlation is that of chance.
  const std::vector<double> a = rough_surface(rough(1), {0.1, 12., 12.}).heights;
  const std::vector<double> b = rough_surface(rough(2), {0.1, 12., 12.}).heights;
  double product = 0.;
  for (std::size_t i = 0; i < a.size(); ++i) product += a[i] * b[i];
  const double correlation =
      product / static_cast<double>(a.size()) / std::sqrt(mean_square(a) * mean_square(b));
  EXPECT_LT(std::abs(correlation), 0.1);
}

// The bytes of these grounds are part of what a seed means: on every machine, build and day.
TEST(RoughSurface, HasTheBytesThatItHasAlwaysHad) {
  EXPECT_EQ(hash_of(rough_surface(rough(1), {0.05, 2., 2.})), 10867226927338568649u);
  RoughGround ground = rough(42);
  ground.flat_radius = 0.3;
  ground.slope = 0.1;
  EXPECT_EQ(hash_of(rough_surface(ground, {0.07, 3., 2.})), 9197760605740128078u);
}

TEST(RoughSurface, SaysWhatIsWrong) {
  EXPECT_EQ(rough_problem(rough(1), {0.05, 4., 4.}), "");
  EXPECT_EQ(
      rough_problem(rough(1), {0.11, 4., 4.}),
      "a spacing of 0.11 m is too coarse for waves of 0.4 m; make it at most a quarter of the "
      "wavelength");
  EXPECT_EQ(rough_problem(rough(1), {0.001, 5., 5.}),
            "5 x 5 m at a spacing of 0.001 m makes 5001 x 5001 vertices, more than 16777216 in "
            "all; raise the spacing or lower the size");
  RoughGround flat = rough(1);
  flat.flat_radius = 3.;
  EXPECT_EQ(rough_problem(flat, {0.05, 4., 4.}),
            "a flat_radius of 3 m leaves nothing rough; the corners are 2.82843 m away");
}

}  // namespace
}  // namespace hookpoint::simulation
