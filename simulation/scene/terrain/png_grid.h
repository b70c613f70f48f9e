// Heights from a grayscale PNG image.
#pragma once

#include <filesystem>
#include <optional>
#include <string>
#include <vector>

namespace hookpoint::simulation {

/// Heights as a GridSurface takes them: row by row, y growing with the row, x with the column.
struct PngGrid {
  int columns = 0, rows = 0;    ///< pixels, one a vertex
  std::vector<double> heights;  ///< [m]
};

/// The grid, or what is wrong with the file.
struct PngGridResult {
  std::optional<PngGrid> grid;
  std::string message;  ///< for the user; empty when there is a grid
};

/// Reads a PNG of 8 or 16 bits of gray, not interlaced. The image's top row is the greatest y, as
/// north is up on a map. Height is linear in the sample as stored, whatever gamma the file names:
/// black (0) is `low` [m], white (255 or 65535) `high` [m]; `low` may be above `high`. Anything
/// else (colour, transparency, another depth, a side below 2 or more than most_grid_vertices
/// pixels, a damaged or cut-off file) is refused. Cost linear in the pixels.
PngGridResult read_png_grid(const std::filesystem::path& path, double low, double high);

}  // namespace hookpoint::simulation
