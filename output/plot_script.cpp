#include <algorithm>
#include <cmath>
#include <locale>
#include <sstream>

#include "output/csv.h"
#include "output/number.h"
#include "output/plot.h"
#include "output/plot_legend.h"
#include "output/plot_scale.h"

namespace hookpoint::output {
namespace {

constexpr double width = 900.;        // of the drawing [px]
constexpr double left_margin = 100.;  // of the axes [px]
constexpr double bottom_margin = 62.;
constexpr double row_height = 17.;  // of a legend entry
constexpr double lead = 34.;        // room for lines from the curves' ends to the legend
constexpr double letter = 7.5;      // mean width of a letter at 12 px, for the legend's share
constexpr const char* note_color = "#777777";
constexpr std::size_t dense = 60;  // more points than this make a line with few markers

std::string axis_title(const Axis& axis) { return typeset(column_title(axis.label, axis.unit)); }

/// Rows of one curve in the data file.
struct Rows {
  std::size_t first = 0, count = 0;
  std::string all() const {
    return "every ::" + std::to_string(first) + "::" + std::to_string(first + count - 1);
  }
  /// About eight of the rows, starting later for later series so that markers of curves that
  /// coincide all show.
  std::string some(std::size_t series, std::size_t series_count) const {
    const std::size_t stride = count > dense ? count / 8 : 1;
    const std::size_t start = first + stride * series / std::max<std::size_t>(series_count, 1);
    return "every " + std::to_string(stride) + "::" + std::to_string(start) +
           "::" + std::to_string(first + count - 1);
  }
};

struct Drawn {
  Rows measured, predicted, unfinished;
};

std::vector<Drawn> count_rows(const Plot& plot) {
  std::vector<Drawn> rows;
  std::size_t next = 0;
  for (const Series& series : plot.series) {
    Drawn drawn;
    drawn.measured = {next, series.measured.x.size()};
    drawn.predicted = {next += drawn.measured.count, series.predicted.x.size()};
    drawn.unfinished = {next += drawn.predicted.count, series.unfinished.size()};
    next += drawn.unfinished.count;
    rows.push_back(drawn);
  }
  return rows;
}

/// What the legend has to explain beside the series' names.
struct Notes {
  bool predicted = false, below_floor = false, negative = false, unfinished = false;
};

Notes notes_of(const Plot& plot, const Layout& layout) {
  Notes notes;
  notes.below_floor = !layout.strips.below_floor.empty();
  notes.unfinished = !layout.strips.unfinished.empty();
  for (const Series& series : plot.series) {
    notes.predicted |= !series.predicted.x.empty();
    for (const double y : series.measured.y)
      notes.negative |= plot.y.logarithmic && y < -plot.y.floor;
  }
  return notes;
}

class Script {
 public:
  explicit Script(const Plot& plot)
      : plot_(plot),
        layout_(lay_out(plot)),
        rows_(count_rows(plot)),
        notes_(notes_of(plot, layout_)) {
    out_.imbue(std::locale::classic());
  }

  std::string text() {
    set_page();
    set_axes();
    set_strips();
    set_legend();
    plot_series();
    return out_.str();
  }

 private:
  double legend_width() const {
    std::size_t longest = 18;
    for (const Series& series : plot_.series) longest = std::max(longest, series.label.size());
    return lead + 44. + letter * static_cast<double>(longest);
  }

  void set_page() {
    const double entries = static_cast<double>(plot_.series.size());
    height_ = std::max(520., std::ceil(row_height * entries) + 150.);
    right_ = 1. - legend_width() / width;
    top_ = 1. - (plot_.subtitle.empty() ? 46. : 64.) / height_;
    out_ << "# Draws " << plot_.name << ".svg from " << plot_.name << ".csv: gnuplot " << plot_.name
         << ".gp\n"
         << "set encoding utf8\n"
         << "set terminal svg size " << width << "," << height_
         << " enhanced font 'Helvetica,13' background '#ffffff' name " << gnuplot_quoted(plot_.name)
         << "\n"
         << "set output " << gnuplot_quoted(plot_.name + ".svg") << "\n"
         << "set datafile separator ','\n"
         << "set lmargin at screen " << rounded(left_margin / width, 5) << "\n"
         << "set rmargin at screen " << rounded(right_, 5) << "\n"
         << "set tmargin at screen " << rounded(top_, 5) << "\n"
         << "set bmargin at screen " << rounded(bottom_margin / height_, 5) << "\n"
         << "set label " << gnuplot_quoted("{/:Bold " + gnuplot_escaped(typeset(plot_.title)) + "}")
         << " at screen " << rounded(left_margin / width, 5) << ", screen "
         << rounded(1. - 22. / height_, 5) << " left font 'Helvetica,15'\n";
    if (!plot_.subtitle.empty())
      out_ << "set label " << gnuplot_quoted(typeset(plot_.subtitle)) << " at screen "
           << rounded(left_margin / width, 5) << ", screen " << rounded(1. - 43. / height_, 5)
           << " left font 'Helvetica,12' tc rgb '#777777' noenhanced\n";
    out_ << "unset key\n";
  }

  void set_axes() {
    out_ << "set border 3 lw 1\nset tics out nomirror scale 0.6,0.35\n"
         << "set grid ytics lc rgb '#dddddd' lw 0.7 lt 1, lc rgb '#dddddd' lw 0\n";
    set_axis("x", plot_.x, layout_.x, "0,0.2");
    set_axis("y", plot_.y, layout_.y, "0.6,0");
  }

  void set_axis(const std::string& axis, const Axis& description, const Scale& scale,
                const std::string& offset) {
    if (scale.logarithmic) out_ << "set logscale " << axis << "\n";
    out_ << "set " << axis << "range [" << shortest(scale.range_low) << ":"
         << shortest(scale.range_high) << "]\n"
         << "set " << axis << "tics " << scale.ticks << "\n"
         << "set " << axis << "label " << gnuplot_quoted(axis_title(description)) << " offset "
         << offset << " noenhanced\n";
  }

  /// A strip is a faint band with its meaning where a tick label would stand.
  void set_strip(double from, double to, const std::string& label) {
    out_ << "set object rectangle from graph 0, graph " << rounded(from, 5) << " to graph 1, graph "
         << rounded(to, 5) << " behind fc rgb '#808080' fs transparent solid 0.1 noborder\n"
         << "set label " << gnuplot_quoted(label) << " at graph -0.012, graph "
         << rounded((from + to) / 2., 5) << " right font 'Helvetica,12'\n";
  }

  std::string floor_text() const {
    const double decade = std::log10(plot_.y.floor);
    if (decade != std::round(decade)) return rounded(plot_.y.floor, 3);
    return "10^{−" + std::to_string(std::lround(-decade)) + "}";
  }

  void set_strips() {
    const Strips& strips = layout_.strips;
    if (notes_.below_floor)
      set_strip(0., strip_height(strips.below_floor.size()), "≤ " + floor_text());
    if (notes_.unfinished) set_strip(1. - strip_height(strips.unfinished.size()), 1., "stopped");
    if (!layout_.y.logarithmic && layout_.y.low < 0. && layout_.y.high > 0.)
      out_
          << "set arrow from graph 0, first 0 to graph 1, first 0 nohead lc rgb '#999999' lw 0.8\n";
    const std::string floor = shortest(layout_.y.floor);
    out_ << "left = " << shortest(layout_.x.range_low) << "\n"
         << "at(x) = " << (layout_.x.logarithmic ? "x > left ? x : left" : "x") << "\n";
    if (!layout_.y.logarithmic) {
      out_ << "shown(y) = y\npositive(y) = y\n";
      return;
    }
    out_ << "floor = " << floor << "\n"
         << "shown(y) = abs(y) > floor ? abs(y) : NaN\n"
         << "positive(y) = y > floor ? y : NaN\n"
         << "negative(y) = y < -floor ? -y : NaN\n"
         << "vanishing(y, lane) = abs(y) <= floor ? lane : NaN\n";
  }

  void add(const std::string& item) {
    out_ << (first_ ? "plot \\\n  " : ", \\\n  ") << item;
    first_ = false;
  }

  void add_rows(const std::string& which, const std::string& y, const std::string& with) {
    add(gnuplot_quoted(plot_.name + ".csv") + " skip 1 " + which + " using (at($3)):(" + y +
        ") with " + with);
  }

  static int lane_of(const std::vector<int>& lanes, std::size_t series) {
    return static_cast<int>(std::find(lanes.begin(), lanes.end(), static_cast<int>(series)) -
                            lanes.begin());
  }

  void plot_series() {
    for (std::size_t i = 0; i < plot_.series.size(); ++i) plot_predicted(i);
    for (std::size_t i = 0; i < plot_.series.size(); ++i) plot_measured(i);
    for (std::size_t i = 0; i < plot_.series.size(); ++i) plot_unfinished(i);
    out_ << "\n";
  }

  void plot_predicted(std::size_t i) {
    const Rows& rows = rows_[i].predicted;
    if (rows.count == 0) return;
    const std::string pen =
        "lines lw 1.3 dt (7,4) lc rgb '" + series_style(plot_.series[i].style).color + "'";
    add_rows(rows.all(), "shown($4)", pen);
    if (!vanishes(plot_.series[i].predicted)) return;
    add_rows(rows.all(), "vanishing($4, " + lane(i) + ")", pen);
  }

  void plot_measured(std::size_t i) {
    const Rows& rows = rows_[i].measured;
    if (rows.count == 0) return;
    const Series& series = plot_.series[i];
    const SeriesStyle style = series_style(series.style);
    const std::string color = " lc rgb '" + style.color + "'";
    const std::string pen = "lines lw 1.6" + color;
    const std::string points = rows.some(i, plot_.series.size());
    const std::string filled =
        "points ps 0.8 lw 1.4 pt " + std::to_string(style.filled_marker) + color;
    const std::string hollow =
        "points ps 0.8 lw 1.4 pt " + std::to_string(style.hollow_marker) + color;
    const bool joined = rows.count > dense || rows_[i].predicted.count == 0;
    const std::string faint = "lines lw 0.8 lc rgb '#80" + style.color.substr(1) + "'";
    add_rows(rows.all(), "shown($4)", joined ? pen : faint);
    add_rows(points, "positive($4)", filled);
    if (layout_.y.logarithmic && negative(series.measured))
      add_rows(points, "negative($4)", hollow);
    if (!vanishes(series.measured)) return;
    const std::string y = "vanishing($4, " + lane(i) + ")";
    if (joined) add_rows(rows.all(), y, pen);
    add_rows(points, y, hollow);
  }

  void plot_unfinished(std::size_t i) {
    if (rows_[i].unfinished.count == 0) return;
    const double y = layout_.unfinished_lane(lane_of(layout_.strips.unfinished, i));
    add_rows(rows_[i].unfinished.all(), shortest(y),
             "points pt 2 ps 0.8 lw 2 lc rgb '" + series_style(plot_.series[i].style).color + "'");
  }

  /// gnuplot drops the entries of a key that it deems too long, and cannot place them beside their
  /// curves, so the legend is drawn entry by entry.
  void set_legend() {
    const LegendRoom room{bottom_margin, top_ * height_, row_height};
    for (const LegendEntry& entry : place_legend(plot_, layout_, room)) {
      const Series& series = plot_.series[entry.series];
      const SeriesStyle style = series_style(series.style);
      const bool joined = series.measured.x.size() > dense || series.predicted.x.empty();
      if (entry.leads)
        out_ << "set arrow from first " << shortest(entry.end_x) << ", first "
             << shortest(entry.end_y) << " to " << beside(lead, entry.height)
             << " nohead lw 0.7 lc rgb '#90" << style.color.substr(1) << "'\n";
      set_entry(series.label, entry.height, style.color, joined ? "1.6" : "", style.filled_marker);
    }
    double height = bottom_margin - 14.;
    const auto note = [&](const char* text, const char* line, int marker) {
      set_entry(text, height, note_color, line, marker);
      height -= 16.;
    };
    if (notes_.predicted) note("closed form", "1.3 dt (7,4)", 0);
    if (notes_.negative) note("hollow: negative", "", 6);
    if (notes_.unfinished) note("did not finish", "", 2);
  }

  /// A place so many pixels right of the axes, at a height over the drawing's bottom.
  std::string beside(double pixels, double height) const {
    return "screen " + rounded(right_ + pixels / width, 5) + ", screen " +
           rounded(height / height_, 5);
  }

  /// A sample of the line (its width and dash, "" for none), of the marker (0 for none), and the
  /// name.
  void set_entry(const std::string& name, double height, const std::string& color,
                 const std::string& line, int marker) {
    const std::string pen = " lc rgb '" + color + "'";
    if (!line.empty())
      out_ << "set arrow from " << beside(lead, height) << " to " << beside(lead + 24., height)
           << " nohead lw " << line << pen << "\n";
    if (marker != 0)
      out_ << "set label '' at " << beside(lead + 12., height) << " point pt " << marker
           << " ps 0.8 lw 1.4" << pen << "\n";
    out_ << "set label " << gnuplot_quoted(name) << " at " << beside(lead + 32., height)
         << " left font 'Helvetica,12' noenhanced\n";
  }

  bool vanishes(const Curve& curve) const {
    return std::any_of(curve.y.begin(), curve.y.end(),
                       [this](double y) { return layout_.y.below_floor(y); });
  }
  bool negative(const Curve& curve) const {
    return std::any_of(curve.y.begin(), curve.y.end(),
                       [this](double y) { return y < -layout_.y.floor; });
  }
  std::string lane(std::size_t i) const {
    return shortest(layout_.floor_lane(lane_of(layout_.strips.below_floor, i)));
  }

  const Plot& plot_;
  Layout layout_;
  std::vector<Drawn> rows_;
  Notes notes_;
  std::ostringstream out_;
  double height_ = 0.;            // of the drawing [px]
  double right_ = 0., top_ = 0.;  // of the axes, shares of the drawing
  bool first_ = true;
};

}  // namespace

std::string plot_script(const Plot& plot) { return Script(plot).text(); }

}  // namespace hookpoint::output
