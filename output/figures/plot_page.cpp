#include "output/figures/plot_page.h"

#include <algorithm>

#include "output/figures/plot_axes.h"
#include "output/figures/terminal_lines.h"
#include "text/number.h"

namespace hookpoint::output {
namespace {

constexpr double letter = 7.5;  // mean width of a letter at 12 px, for the legend's share
constexpr const char* note_color = "#777777";

}  // namespace

Notes notes_of(const Plot& plot, const Layout& layout) {
  Notes notes;
  notes.below_floor = !layout.strips.below_floor.empty();
  notes.unfinished = !layout.strips.unfinished.empty();
  for (const Series& series : plot.series) {
    notes.predicted |= !series.reference && !series.predicted.x.empty();
    for (const double y : series.measured.y)
      notes.negative |= plot.y.logarithmic && y < -plot.y.floor;
  }
  return notes;
}

Notes operator|(const Notes& one, const Notes& other) {
  return {.predicted = one.predicted || other.predicted,
          .below_floor = one.below_floor || other.below_floor,
          .negative = one.negative || other.negative,
          .unfinished = one.unfinished || other.unfinished};
}

double title_height(const std::string& subtitle) { return subtitle.empty() ? 46. : 64.; }

double legend_width(const std::vector<Series>& series) {
  std::size_t longest = 18;
  for (const Series& each : series) longest = std::max(longest, each.label.size());
  return PlotPage::lead + 44. + letter * static_cast<double>(longest);
}

std::string line_color(const Series& series) {
  return series.reference ? "#000000" : series_style(series.style).color;
}

std::string PlotPage::at(double x, double y) const {
  return "screen " + text::rounded(x / width_, 5) + ", screen " + text::rounded(y / height_, 5);
}

void PlotPage::text(double x, double y, const std::string& text, const std::string& look) {
  out_ << "set label " << gnuplot_quoted(text) << " at " << at(x, y) << " left " << look << "\n";
}

void PlotPage::open(const std::string& name, const std::string& title,
                    const std::string& subtitle) {
  const std::string shown = one_line(name);
  out_ << "# Draws " << shown << ".svg from " << shown << ".csv: gnuplot " << shown << ".gp\n"
       << "set encoding utf8\n"
       << svg_terminal(name, width_, height_) << "set datafile separator ','\n"
       << "unset key\n";
  text(left_margin, height_ - 22., "{/:Bold " + gnuplot_escaped(typeset(title)) + "}",
       "font 'Helvetica,15'");
  if (!subtitle.empty())
    text(left_margin, height_ - 43., typeset(subtitle),
         "font 'Helvetica,12' tc rgb '#777777' noenhanced");
}

void PlotPage::set_frame(const Frame& frame) {
  out_ << "set lmargin at screen " << text::rounded(frame.left / width_, 5) << "\n"
       << "set rmargin at screen " << text::rounded(frame.right / width_, 5) << "\n"
       << "set tmargin at screen " << text::rounded(frame.top / height_, 5) << "\n"
       << "set bmargin at screen " << text::rounded(frame.bottom / height_, 5) << "\n";
}

void PlotPage::entry(double x, double y, const std::string& name, const std::string& color,
                     const std::string& line, int marker) {
  const std::string pen = " lc rgb '" + color + "'";
  if (!line.empty())
    out_ << "set arrow from " << at(x, y) << " to " << at(x + 24., y) << " nohead lw " << line
         << pen << "\n";
  if (marker != 0)
    out_ << "set label '' at " << at(x + 12., y) << " point pt " << marker << " ps 0.8 lw 1.4"
         << pen << "\n";
  text(x + 32., y, name, "font 'Helvetica,12' noenhanced");
}

void PlotPage::legend_entry(double x, double y, const Series& series) {
  if (series.reference)
    return entry(x, y, series.label, line_color(series),
                 "1.3" + dash_type(reference_dashes(series.style)), 0);
  const SeriesStyle style = series_style(series.style);
  const bool dashed = !series.scattered && !style.dashes.empty();
  entry(x, y, series.label, line_color(series),
        joined(series) || dashed ? "1.6" + dash_type(style.dashes) : "", style.filled_marker());
}

void PlotPage::legend_notes(double x, double y, const Notes& notes) {
  const auto note = [&](const char* text, const std::string& line, int marker) {
    entry(x, y, text, note_color, line, marker);
    y -= 16.;
  };
  if (notes.predicted) note("closed form", "1.3" + dash_type(predicted_dashes()), 0);
  if (notes.negative) note("hollow: negative", "", 6);
  if (notes.unfinished) note("did not finish", "", 2);
}

}  // namespace hookpoint::output
