// Figures for papers: a Plot value in; its data (.csv), a readable gnuplot script (.gp) and the
// drawing (.svg) out. The same Plot gives the same bytes. A series has one colour and one marker,
// pinned by its `style` number, in every figure.
//
// Nothing is dropped silently. On a logarithmic axis a value within `floor` of zero is drawn hollow
// in a strip under the axis, one lane a series, labelled "<= floor"; a negative value is drawn
// hollow at its magnitude; a run that did not finish is a cross in a strip on top. Notes say so
// when it happens. Names stand at the ends of their curves.
#pragma once

#include <filesystem>
#include <string>
#include <string_view>
#include <vector>

namespace hookpoint::output {

struct Axis {
  std::string label;  ///< "creep speed"
  std::string unit;   ///< "m/s"; "" for none
  bool logarithmic = false;
  double floor = 1e-16;  ///< magnitude that counts as zero on a logarithmic axis, in `unit`
  std::vector<std::string> names = {};  ///< of what stands at 0, 1, 2 ...; empty: numbers
};

/// Points in the units of the axes. Values that are not finite belong in Series::unfinished.
struct Curve {
  std::vector<double> x, y;
};

struct Series {
  std::string label;
  int style = 0;  ///< which colour and marker, >= 0: the subject's number in its study
  Curve measured;
  Curve predicted;                 ///< dashed; empty for none
  std::vector<double> unfinished;  ///< x of the runs that gave no value
  /// A line to hold the others against: only `predicted`, black; the style says which dashes.
  bool reference = false;
  /// Every point by itself, no line from one to the next.
  bool scattered = false;
  std::vector<double> half_widths = {};  ///< of bars about each measured y; empty for none
};

struct Plot {
  std::string name;  ///< file name without extension
  std::string title;
  std::string subtitle;  ///< what is held fixed: "mu = 0.8, dt = 1 ms"
  Axis x, y;
  std::vector<Series> series;
};

/// How many colours there are: styles s and s + style_colors share a colour and differ in marker,
/// or where the markers are used up in the dashes of the line.
inline constexpr int style_colors = 20;
/// How many markers.
inline constexpr int style_shapes = 5;
/// The style of this colour is grey.
inline constexpr int grey_style = 7;

/// Lengths of strokes and of the gaps after them, in turns; empty for a solid line.
using Dashes = std::vector<int>;
/// "dt (7,4)", as gnuplot takes it, with a blank before it; "" for a solid line.
std::string dash_type(const Dashes& dashes);
/// The dashes of a closed form.
Dashes predicted_dashes();
/// The dashes of a reference line; the closed form's for style 0. They repeat after four.
Dashes reference_dashes(int style);

/// Colour, marker and dashes of a series. All three together repeat after 400 styles.
struct SeriesStyle {
  std::string color;  ///< "#0072B2"
  int shape = 0;      ///< of the marker: circle, square, triangle, diamond, pentagon
  Dashes dashes;      ///< of the line through measured points
  /// gnuplot's point types.
  int filled_marker() const;
  int hollow_marker() const { return filled_marker() - 1; }
};
SeriesStyle series_style(int style);

/// Rows `series, kind (measured, predicted, reference, unfinished), x, y`, a series' rows together;
/// where measured points have bars, half the width of each besides; where x has names, the name.
std::string plot_data(const Plot& plot);

/// The script that draws `<name>.svg` from `<name>.csv` in the folder where it is run.
std::string plot_script(const Plot& plot);

/// Small multiples: panels of one size over the same x, with one legend.
struct PanelPlot {
  std::string name;  ///< file name without extension
  std::string title;
  std::string subtitle;
  std::size_t across = 2;  ///< panels in a row
  bool own_axes = false;   ///< each panel has a y axis of its own, else all have the same
  /// With axes of the same names, and series that are the same in number, order, label and style;
  /// a curve may be empty. Their names and subtitles are not drawn.
  std::vector<Plot> panels;
};

/// As `plot_data`, with the panel's title behind each row.
std::string panel_data(const PanelPlot& plot);
std::string panel_script(const PanelPlot& plot);

/// Types of the files that a figure may leave: NAME.csv and NAME.gp, its drawings, and what takes it
/// into a paper (output/latex/).
inline constexpr const char* figure_types[] = {".svg", ".csv", ".gp", ".pdf", ".tex"};

/// Runs gnuplot in `folder` on `script`, a file from there on, which draws the file `drawing`; an older
/// one must not pass for it.
struct GnuplotOutcome {
  std::string drawing;  ///< its bytes; "" when it could not be drawn
  std::string message;  ///< why not
};
GnuplotOutcome run_gnuplot(const std::filesystem::path& folder, const std::string& script,
                           const std::string& drawing);

struct PlotOutcome {
  bool drawn = false;
  std::string message;  ///< why not; "" when drawn
  std::string svg;      ///< the drawing's text
};

/// Writes `<folder>/<name>.csv` and `.gp`, and the `.svg` that the script draws if gnuplot can be
/// run. Throws FileError, also for a name that gnuplot would not take for a file's.
PlotOutcome draw_files(const std::string& name, const std::string& data, const std::string& script,
                       const std::filesystem::path& folder);
PlotOutcome draw(const Plot& plot, const std::filesystem::path& folder);
PlotOutcome draw(const PanelPlot& plot, const std::filesystem::path& folder);

/// Control characters as blanks: gnuplot ends a comment or an open quote with the line, and what
/// follows would be a command.
std::string one_line(std::string_view text);
/// gnuplot's single-quoted string, in which it expands nothing. All text of others goes through
/// here.
std::string gnuplot_quoted(std::string_view text);
/// Text in which gnuplot's markup characters stand for themselves, and "m/s^2" as a reader writes
/// it.
std::string gnuplot_escaped(std::string_view text);
std::string typeset(std::string text);
/// What stands beside the axis: its label with the unit.
std::string axis_title(const Axis& axis);

}  // namespace hookpoint::output
