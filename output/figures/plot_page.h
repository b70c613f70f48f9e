// The sheet that a figure's axes and legend stand on, as gnuplot's commands. Pixels from the lower
// left corner.
#pragma once

#include <ostream>
#include <string>

#include "output/figures/plot.h"
#include "output/figures/plot_scale.h"

namespace hookpoint::output {

/// What the legend has to explain beside the series' names.
struct Notes {
  bool predicted = false, below_floor = false, negative = false, unfinished = false;
};
Notes notes_of(const Plot& plot, const Layout& layout);
Notes operator|(const Notes& one, const Notes& other);

/// Where axes stand [px].
struct Frame {
  double left = 0., right = 0., bottom = 0., top = 0.;
};

class PlotPage {
 public:
  static constexpr double left_margin = 100.;   ///< of the axes [px]
  static constexpr double bottom_margin = 62.;  ///< of the axes [px]
  static constexpr double row_height = 17.;     ///< of a legend entry [px]
  static constexpr double lead = 34.;           ///< between axes and legend [px]

  PlotPage(std::ostream& out, double width, double height)
      : out_(out), width_(width), height_(height) {}

  /// Terminal, file names, title and subtitle ("" for none).
  void open(const std::string& name, const std::string& title, const std::string& subtitle);
  void set_frame(const Frame& frame);
  /// A sample of the series' line and marker, and its label, from `x` on, in the middle of `y`.
  void legend_entry(double x, double y, const Series& series);
  /// One below the other, from `y` down.
  void legend_notes(double x, double y, const Notes& notes);
  void text(double x, double y, const std::string& text, const std::string& look);
  /// "screen 0.1, screen 0.9"
  std::string at(double x, double y) const;

 private:
  void entry(double x, double y, const std::string& name, const std::string& color,
             const std::string& line, int marker);

  std::ostream& out_;
  double width_, height_;
};

/// Room for the title, and the subtitle if there is one, above the axes [px].
double title_height(const std::string& subtitle);
/// Room for the legend, from the axes' right edge on [px].
double legend_width(const std::vector<Series>& series);
/// How a series' lines are coloured: "#0072B2".
std::string line_color(const Series& series);

}  // namespace hookpoint::output
