#include <fmt/format.h>

#include <algorithm>
#include <cmath>

#include "simulation/scene/terrain/surface.h"

namespace hookpoint::simulation {
namespace {

/// Cells on either side of the origin. A size that is a whole number of cells but for rounding is
/// that number.
double half_cells(double size, double spacing) {
  constexpr double rounding = 1e-9;
  return std::max(1., std::ceil(0.5 * size / spacing - rounding));
}

}  // namespace

std::string extent_problem(const Extent& extent) {
  const double columns = 2. * half_cells(extent.size_x, extent.spacing) + 1.;
  const double rows = 2. * half_cells(extent.size_y, extent.spacing) + 1.;
  const double longest = std::max(columns, rows);
  const bool too_many = columns * rows > contact::most_grid_vertices;
  if (!too_many && longest <= contact::most_grid_side) return "";
  return fmt::format(
      "{:g} x {:g} m at a spacing of {:g} m makes {:.6g} x {:.6g} vertices, more than {}; raise "
      "the "
      "spacing or lower the size",
      extent.size_x, extent.size_y, extent.spacing, columns, rows,
      too_many ? fmt::format("{} in all", contact::most_grid_vertices)
               : fmt::format("{} along a side", contact::most_grid_side));
}

GridSpec level_grid(const Extent& extent) {
  const double half_columns = half_cells(extent.size_x, extent.spacing);
  const double half_rows = half_cells(extent.size_y, extent.spacing);
  GridSpec grid;
  grid.columns = 2 * static_cast<int>(half_columns) + 1;
  grid.rows = 2 * static_cast<int>(half_rows) + 1;
  grid.origin_x = -half_columns * extent.spacing;
  grid.origin_y = -half_rows * extent.spacing;
  grid.heights.resize(static_cast<std::size_t>(grid.columns) * grid.rows);
  return grid;
}

}  // namespace hookpoint::simulation
