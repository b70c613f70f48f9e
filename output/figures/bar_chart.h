// Bars for papers: a few numbers side by side for each of several things. Files as in plot.h: data
// (.csv), gnuplot script (.gp), drawing (.svg).
#pragma once

#include <filesystem>
#include <string>
#include <vector>

#include "output/figures/plot.h"

namespace hookpoint::output {

struct BarSeries {
  std::string label;
  int style = 0;               ///< its colour, as of a Series
  std::vector<double> values;  ///< one a group, finite
  /// Ends of an interval about each value, drawn as a thin bar; empty for none.
  std::vector<double> low{}, high{};
};

/// Groups stand one below the other, bars lie.
struct BarChart {
  std::string name;  ///< file name without extension
  std::string title;
  std::string subtitle;
  Axis value;
  std::vector<std::string> groups;
  std::vector<BarSeries> series;
};

/// Rows `group, series, value, row`, a series' rows together; where a series has intervals, their
/// ends besides.
std::string bar_chart_data(const BarChart& chart);
/// The script that draws `<name>.svg` from `<name>.csv` in the folder where it is run.
std::string bar_chart_script(const BarChart& chart);
/// As `draw` of a Plot.
PlotOutcome draw(const BarChart& chart, const std::filesystem::path& folder);

}  // namespace hookpoint::output
