// Compiled as surface_rough.cpp is, for the same reason.
#include <fmt/format.h>

#include <algorithm>
#include <cmath>

#include "math/sine_cosine.h"
#include "simulation/scene/terrain/surface.h"

namespace hookpoint::simulation {

std::string steps_problem(const StepsGround& steps, const Extent& extent) {
  if (steps.run > extent.spacing) return extent_problem(extent);
  return fmt::format(
      "a run of {:g} m leaves no tread beside a riser one cell, {:g} m, wide; lengthen the run or "
      "lower the spacing",
      steps.run, extent.spacing);
}

[[gnu::flatten]] GridSpec steps_surface(const StepsGround& steps, const Extent& extent) {
  GridSpec grid = level_grid(extent);
  const SineCosine<double> uphill = polynomial_sine_cosine(steps.azimuth);
  const double farthest = std::abs(uphill.cosine) * grid.columns * extent.spacing / 2. +
                          std::abs(uphill.sine) * grid.rows * extent.spacing / 2.;
  const double to_the_edge = std::max(0., std::ceil((farthest - steps.from) / steps.run));
  if (steps.height != 0.)
    grid.stairs = {{uphill.cosine, uphill.sine, 0.},
                   steps.from,
                   steps.run,
                   steps.height,
                   std::min(steps.count, to_the_edge)};
  const int middle_row = grid.rows / 2, middle_column = grid.columns / 2;
  std::size_t vertex = 0;
  for (int row = 0; row < grid.rows; ++row) {
    for (int column = 0; column < grid.columns; ++column) {
      const double x = (column - middle_column) * extent.spacing;
      const double y = (row - middle_row) * extent.spacing;
      const double along = uphill.cosine * x + uphill.sine * y - steps.from;
      const double climbed = std::floor(along / steps.run);
      const double on_riser = std::min((along - climbed * steps.run) / extent.spacing, 1.);
      grid.heights[vertex++] = steps.height * std::clamp(climbed + on_riser, 0., steps.count);
    }
  }
  return grid;
}

}  // namespace hookpoint::simulation
