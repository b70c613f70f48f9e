// Compiled without contraction of a b + c to one rounding (CMakeLists.txt), and `flatten` keeps the
// inline functions that it calls from being shared with files compiled otherwise: the heights are
// to be the same bytes on every machine.
#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <numbers>

#include "control/random.h"
#include "math/sine_cosine.h"
#include "simulation/scene/terrain/surface.h"

namespace hookpoint::simulation {
namespace {

constexpr int wave_count = 64;

/// cos(k_x x + k_y y + phase)
struct Wave {
  double k_x = 0., k_y = 0.;  ///< [rad/m]
  double phase = 0.;          ///< [rad]
};

/// Equal areas of the ring hold equally many wave vectors: |k|^2 is uniform between k^2/2 and 2
/// k^2. Half a turn of directions is all there are (k and -k are one wave), one in each 64th of it.
[[gnu::flatten]] std::vector<Wave> random_waves(const RoughGround& rough) {
  const control::RandomStream stream(control::stream_key(rough.seed, "Terrain.Rough"));
  const double middle = 2. * std::numbers::pi / rough.wavelength;
  std::vector<Wave> waves;
  for (int n = 0; n < wave_count; ++n) {
    const std::uint64_t draw = 3 * static_cast<std::uint64_t>(n);
    const SineCosine<double> direction =
        polynomial_sine_cosine(std::numbers::pi * ((n + stream.uniform(draw)) / wave_count));
    const double k = middle * std::sqrt(0.5 + 1.5 * stream.uniform(draw + 1));
    waves.push_back({k * direction.cosine, k * direction.sine,
                     2. * std::numbers::pi * stream.uniform(draw + 2)});
  }
  return waves;
}

/// The sum of the waves at every vertex, by cos(a + b) = cos a cos b - sin a sin b: sines and
/// cosines are needed of a column or a row alone.
[[gnu::flatten]] void add_waves(const std::vector<Wave>& waves, double spacing, GridSpec& grid) {
  const std::size_t columns = static_cast<std::size_t>(grid.columns);
  const int middle_row = grid.rows / 2, middle_column = grid.columns / 2;
  std::vector<SineCosine<double>> along_x;
  for (const Wave& wave : waves) {
    for (int column = 0; column < grid.columns; ++column) {
      const double x = (column - middle_column) * spacing;
      along_x.push_back(polynomial_sine_cosine(wave.k_x * x));
    }
  }
  for (int row = 0; row < grid.rows; ++row) {
    const double y = (row - middle_row) * spacing;
    double* heights = grid.heights.data() + static_cast<std::size_t>(row) * columns;
    for (std::size_t n = 0; n < waves.size(); ++n) {
      const SineCosine<double> b = polynomial_sine_cosine(waves[n].k_y * y + waves[n].phase);
      const SineCosine<double>* a = along_x.data() + n * columns;
      for (std::size_t i = 0; i < columns; ++i) {
        heights[i] += a[i].cosine * b.cosine - a[i].sine * b.sine;
      }
    }
  }
}

/// 0 within the flat radius, 1 from one wavelength beyond it, joined with continuous curvature.
double roughness_at(const RoughGround& rough, double x, double y) {
  if (rough.flat_radius == 0.) return 1.;
  const double t = (std::sqrt(x * x + y * y) - rough.flat_radius) / rough.wavelength;
  const double s = std::clamp(t, 0., 1.);
  return s * s * s * (10. + s * (6. * s - 15.));
}

/// Calls `change(height, x, y)` for every vertex.
template <class Change>
void for_every_vertex(GridSpec& grid, double spacing, Change change) {
  const int middle_row = grid.rows / 2, middle_column = grid.columns / 2;
  std::size_t vertex = 0;
  for (int row = 0; row < grid.rows; ++row) {
    for (int column = 0; column < grid.columns; ++column) {
      change(grid.heights[vertex++], (column - middle_column) * spacing,
             (row - middle_row) * spacing);
    }
  }
}

}  // namespace

std::string rough_problem(const RoughGround& rough, const Extent& extent) {
  if (!(extent.spacing <= 0.25 * rough.wavelength)) {
    return fmt::format(
        "a spacing of {:g} m is too coarse for waves of {:g} m; make it at most a quarter of the "
        "wavelength",
        extent.spacing, rough.wavelength);
  }
  const std::string problem = extent_problem(extent);
  if (!problem.empty()) return problem;
  const double corner =
      0.5 * std::sqrt(extent.size_x * extent.size_x + extent.size_y * extent.size_y);
  if (rough.flat_radius < corner) return "";
  return fmt::format("a flat_radius of {:g} m leaves nothing rough; the corners are {:g} m away",
                     rough.flat_radius, corner);
}

[[gnu::flatten]] GridSpec rough_surface(const RoughGround& rough, const Extent& extent) {
  GridSpec grid = level_grid(extent);
  add_waves(random_waves(rough), extent.spacing, grid);

  // h = w (z - m) with m such that the sum of h is 0, scaled so that the largest |h| is the
  // amplitude.
  double weight = 0., weighted = 0.;
  for_every_vertex(grid, extent.spacing, [&](double height, double x, double y) {
    const double w = roughness_at(rough, x, y);
    weight += w;
    weighted += w * height;
  });
  const double mean = weighted / weight;
  double largest = 0.;
  for_every_vertex(grid, extent.spacing, [&](double& height, double x, double y) {
    height = roughness_at(rough, x, y) * (height - mean);
    largest = std::max(largest, std::abs(height));
  });
  const SineCosine<double> slope = polynomial_sine_cosine(rough.slope);
  const SineCosine<double> fall = polynomial_sine_cosine(rough.azimuth);
  const double gradient = slope.sine / slope.cosine;
  for_every_vertex(grid, extent.spacing, [&](double& height, double x, double y) {
    height = rough.amplitude * (height / largest) - gradient * (x * fall.cosine + y * fall.sine);
  });
  return grid;
}

}  // namespace hookpoint::simulation
