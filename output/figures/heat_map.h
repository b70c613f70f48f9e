// Maps for papers: a value over two things that were varied, a coloured and labelled cell for each
// pair. Cells are of one size whatever the steps between their values. A run that gave no value is
// a cross, or white among very many; where the closed form changes between neighbours, a line goes
// between them. Files as in plot.h: data (.csv), gnuplot script (.gp), drawing (.svg).
#pragma once

#include <filesystem>
#include <optional>
#include <string>
#include <vector>

#include "output/figures/plot.h"

namespace hookpoint::output {

struct HeatMapCell {
  bool run = false;  ///< whether there was a run at all; a cell without one stays empty
  std::optional<double> value;
  std::optional<double> predicted;  ///< of what the line divides: any number, compared only
};

/// What one subject did: rows of cells, row after row from the bottom, x innermost.
struct HeatMapPanel {
  std::string title;
  std::vector<HeatMapCell> cells;
};

struct HeatMap {
  std::string name;  ///< file name without extension
  std::string title;
  std::string subtitle;
  Axis x, y, color;  ///< names and units; a logarithmic colour begins at its floor
  std::vector<double> x_values, y_values;
  std::vector<HeatMapPanel> panels;  ///< side by side, of one scale of colours
  bool less_is_better = false;       ///< the least has the blue of the greatest
};

/// Whether cells are so many that their numbers could not be read: they are colours alone then.
bool crowded(const HeatMap& map);

/// Rows `panel, x, y, value, column, row`, x and y as numbers or names; of a run without a value
/// the value is empty, and in a crowded map that of a cell without a run.
std::string heat_map_data(const HeatMap& map);
/// The script that draws `<name>.svg` from `<name>.csv` in the folder where it is run.
std::string heat_map_script(const HeatMap& map);
/// As `draw` of a Plot.
PlotOutcome draw(const HeatMap& map, const std::filesystem::path& folder);

}  // namespace hookpoint::output
