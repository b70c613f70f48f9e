// Heights from a text file: an ESRI ASCII grid, or a plain matrix of numbers.
#pragma once

#include <filesystem>
#include <istream>
#include <optional>
#include <string>
#include <vector>

namespace hookpoint::simulation {

/// Heights as a GridSurface takes them: row by row, y growing with the row, x with the column.
struct AsciiGrid {
  int columns = 0, rows = 0;
  std::vector<double> heights;     ///< [m]
  std::optional<double> spacing;   ///< `cellsize` [m], when the file says it
  std::optional<double> origin_x;  ///< `xllcorner` or `xllcenter` [m]
  std::optional<double> origin_y;  ///< `yllcorner` or `yllcenter` [m]
};

/// The grid, or what is wrong with the file and where.
struct AsciiGridResult {
  std::optional<AsciiGrid> grid;
  std::string message;  ///< for the user; empty when there is a grid
  int line = 0;         ///< of the mistake, from 1; 0 when it is not in one line
};

/// Reads heights in metres, separated by blanks.
///   With a header (`ncols`, `nrows`, then any of `xllcorner`/`xllcenter`, `yllcorner`/`yllcenter`,
///   `cellsize`, `NODATA_value`, in any case and order) the first line of numbers is the
///   northernmost, greatest y, as ESRI has it. The numbers are heights of vertices, so that corner
///   and center both name the lower left vertex. A NODATA height is an error: the ground has no
///   holes. Without a header every line is a row of equal length, the first at the least y.
/// Cost linear in the size of the file.
AsciiGridResult read_ascii_grid(std::istream& stream);

/// The same from a file; a file that cannot be opened is an error of line 0.
AsciiGridResult read_ascii_grid(const std::filesystem::path& path);

}  // namespace hookpoint::simulation
