#include "output/figures/plot_axes.h"

#include <algorithm>
#include <cmath>

#include "output/figures/plot_page.h"
#include "output/files/csv.h"
#include "text/number.h"

namespace hookpoint::output {
namespace {

constexpr std::size_t dense = 60;  // more points than this make a line with few markers

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

std::vector<Drawn> count_rows(const Plot& plot, std::size_t next) {
  std::vector<Drawn> rows;
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

class AxesScript {
 public:
  AxesScript(std::ostream& out, const Plot& plot, const Layout& layout, const std::string& name,
             std::size_t first_row)
      : out_(out),
        plot_(plot),
        layout_(layout),
        file_(name + ".csv"),
        rows_(count_rows(plot, first_row)) {}

  void write(AxisTitles titles) {
    set_axes(titles);
    set_strips();
    plot_series();
  }
  std::size_t next_row(std::size_t first_row) const {
    return rows_.empty() ? first_row
                         : rows_.back().unfinished.first + rows_.back().unfinished.count;
  }

 private:
  void set_axes(AxisTitles titles) {
    out_ << "set border 3 lw 1\nset tics out nomirror scale 0.6,0.35\n"
         << "set grid ytics lc rgb '#dddddd' lw 0.7 lt 1, lc rgb '#dddddd' lw 0\n";
    set_axis("x", layout_.x, titles.x ? axis_title(plot_.x) : "", "0,0.2");
    set_axis("y", layout_.y, titles.y ? axis_title(plot_.y) : "", "0.6,0");
  }

  void set_axis(const std::string& axis, const Scale& scale, const std::string& title,
                const std::string& offset) {
    if (scale.logarithmic) out_ << "set logscale " << axis << "\n";
    out_ << "set " << axis << "range [" << text::shortest(scale.range_low) << ":"
         << text::shortest(scale.range_high) << "]\n"
         << "set " << axis << "tics " << scale.ticks << "\n"
         << "set " << axis << "label " << gnuplot_quoted(title) << " offset " << offset
         << " noenhanced\n";
  }

  /// A strip is a faint band with its meaning where a tick label would stand.
  void set_strip(double from, double to, const std::string& label) {
    out_ << "set object rectangle from graph 0, graph " << text::rounded(from, 5)
         << " to graph 1, graph " << text::rounded(to, 5)
         << " behind fc rgb '#808080' fs transparent solid 0.1 noborder\n"
         << "set label " << gnuplot_quoted(label) << " at graph -0.012, graph "
         << text::rounded((from + to) / 2., 5) << " right font 'Helvetica,12'\n";
  }

  std::string floor_text() const {
    const double decade = std::log10(plot_.y.floor);
    if (decade != std::round(decade)) return text::rounded(plot_.y.floor, 3);
    return "10^{−" + std::to_string(std::lround(-decade)) + "}";
  }

  void set_strips() {
    const Strips& strips = layout_.strips;
    if (!strips.below_floor.empty())
      set_strip(0., strip_height(strips.below_floor.size()), "≤ " + floor_text());
    if (!strips.unfinished.empty())
      set_strip(1. - strip_height(strips.unfinished.size()), 1., "stopped");
    if (!layout_.y.logarithmic && layout_.y.low < 0. && layout_.y.high > 0.)
      out_
          << "set arrow from graph 0, first 0 to graph 1, first 0 nohead lc rgb '#999999' lw 0.8\n";
    const std::string floor = text::shortest(layout_.y.floor);
    out_ << "left = " << text::shortest(layout_.x.range_low) << "\n"
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
    add(gnuplot_quoted(file_) + " skip 1 " + which + " using (at($3)):(" + y + ") with " + with);
  }

  static int lane_of(const std::vector<int>& lanes, std::size_t series) {
    return static_cast<int>(std::find(lanes.begin(), lanes.end(), static_cast<int>(series)) -
                            lanes.begin());
  }

  void plot_series() {
    plot_predicted(false);
    for (std::size_t i = 0; i < plot_.series.size(); ++i) plot_measured(i);
    for (std::size_t i = 0; i < plot_.series.size(); ++i) plot_unfinished(i);
    plot_predicted(true);  // curves that come to a reference must not hide it
    out_ << "\n";
  }

  void plot_predicted(bool references) {
    for (std::size_t i = 0; i < plot_.series.size(); ++i)
      if (plot_.series[i].reference == references) plot_predicted_of(i);
  }

  void plot_predicted_of(std::size_t i) {
    const Rows& rows = rows_[i].predicted;
    if (rows.count == 0) return;
    const Series& series = plot_.series[i];
    const std::string color = " lc rgb '" + line_color(series) + "'";
    if (!plot_.x.names.empty() && !series.reference) return add_bars(rows, color);
    const Dashes dashes = series.reference ? reference_dashes(series.style) : predicted_dashes();
    const std::string pen = "lines lw 1.3" + dash_type(dashes) + color;
    add_rows(rows.all(), "shown($4)", pen);
    if (!vanishes(series.predicted)) return;
    add_rows(rows.all(), "vanishing($4, " + lane(i) + ")", pen);
  }

  /// A bar about each point, cut off where a logarithmic axis has no place for its lower end.
  void add_intervals(const Rows& rows, const std::string& color) {
    const std::string low =
        layout_.y.logarithmic ? "($4 - $5 > floor ? $4 - $5 : floor)" : "($4 - $5)";
    add(gnuplot_quoted(file_) + " skip 1 " + rows.all() + " using (at($3)):(positive($4)):" + low +
        ":($4 + $5) with yerrorbars pt -1 lw 1.2 lt 1" + color);
  }

  /// Of the closed form over names: a dashed bar across each.
  void add_bars(const Rows& rows, const std::string& color) {
    constexpr const char* half_width = "0.3";
    add(gnuplot_quoted(file_) + " skip 1 " + rows.all() + " using ($3 - " + half_width +
        "):(shown($4)):(2*" + half_width + "):(0) with vectors nohead lw 1.3" +
        dash_type(predicted_dashes()) + color);
  }

  void plot_measured(std::size_t i) {
    const Rows& rows = rows_[i].measured;
    if (rows.count == 0) return;
    const Series& series = plot_.series[i];
    const SeriesStyle style = series_style(series.style);
    const std::string color = " lc rgb '" + style.color + "'";
    const std::string dashed = dash_type(style.dashes) + color;
    const std::string pen = "lines lw 1.6" + dashed;
    const std::string points = series.scattered ? rows.all() : rows.some(i, plot_.series.size());
    const std::string filled =
        "points ps 0.8 lw 1.4 pt " + std::to_string(style.filled_marker()) + color;
    const std::string hollow =
        "points ps 0.8 lw 1.4 pt " + std::to_string(style.hollow_marker()) + color;
    const bool is_joined = joined(series);
    const std::string faint =
        "lines lw 0.8" + dash_type(style.dashes) + " lc rgb '#80" + style.color.substr(1) + "'";
    if (!series.scattered) add_rows(rows.all(), "shown($4)", is_joined ? pen : faint);
    // The bars first: gnuplot clears the place of their points.
    if (!series.half_widths.empty()) add_intervals(rows, color);
    add_rows(points, "positive($4)", filled);
    if (layout_.y.logarithmic && negative(series.measured))
      add_rows(points, "negative($4)", hollow);
    if (!vanishes(series.measured)) return;
    const std::string y = "vanishing($4, " + lane(i) + ")";
    if (is_joined) add_rows(rows.all(), y, pen);
    add_rows(points, y, hollow);
  }

  void plot_unfinished(std::size_t i) {
    if (rows_[i].unfinished.count == 0) return;
    const double y = layout_.unfinished_lane(lane_of(layout_.strips.unfinished, i));
    add_rows(rows_[i].unfinished.all(), text::shortest(y),
             "points pt 2 ps 0.8 lw 2 lc rgb '" + series_style(plot_.series[i].style).color + "'");
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
    return text::shortest(layout_.floor_lane(lane_of(layout_.strips.below_floor, i)));
  }

  std::ostream& out_;
  const Plot& plot_;
  const Layout& layout_;
  std::string file_;
  std::vector<Drawn> rows_;
  bool first_ = true;
};

}  // namespace

bool joined(const Series& series) {
  return !series.scattered && (series.measured.x.size() > dense || series.predicted.x.empty());
}

std::size_t write_axes(std::ostream& out, const Plot& plot, const Layout& layout,
                       const std::string& name, std::size_t first_row, AxisTitles titles) {
  AxesScript script(out, plot, layout, name, first_row);
  script.write(titles);
  return script.next_row(first_row);
}

}  // namespace hookpoint::output
