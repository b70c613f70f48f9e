#include "output/figures/bar_chart.h"

#include <algorithm>
#include <locale>
#include <sstream>

#include "output/figures/plot_page.h"
#include "output/files/csv.h"
#include "text/number.h"

namespace hookpoint::output {
namespace {

constexpr double bar_height = 11., group_gap = 10., bars_width = 420.;  // [px]
constexpr double label_letter = 6.8;  // mean width of a letter of a group's name [px]

double label_room(const BarChart& chart) {
  std::size_t longest = 8;
  for (const std::string& group : chart.groups) longest = std::max(longest, group.size());
  return 30. + label_letter * static_cast<double>(longest);
}

/// Where a bar lies: groups are 1 apart, from 0 downwards.
double bar_row(const BarChart& chart, std::size_t group, std::size_t series) {
  const auto bars = static_cast<double>(chart.series.size());
  const double of_group = bar_height / (bars * bar_height + group_gap);
  return -static_cast<double>(group) + of_group * (0.5 * (bars - 1.) - static_cast<double>(series));
}

bool has_no_intervals(const BarSeries& bars) { return bars.low.empty(); }

Series legend_series(const BarSeries& bars) { return {bars.label, bars.style, {}, {}, {}}; }

}  // namespace

std::string bar_chart_data(const BarChart& chart) {
  CsvTable table;
  const std::string title = column_title(chart.value.label, chart.value.unit);
  const bool intervals = !std::ranges::all_of(chart.series, has_no_intervals);
  table.header = {"group", "series", title, "row"};
  if (intervals) table.header.insert(table.header.end(), {"low", "high"});
  for (std::size_t s = 0; s < chart.series.size(); ++s) {
    const BarSeries& bars = chart.series[s];
    for (std::size_t g = 0; g < chart.groups.size(); ++g) {
      std::vector<std::string>& row = table.rows.emplace_back();
      row = {chart.groups[g], bars.label, text::shortest(bars.values[g]),
             text::rounded(bar_row(chart, g, s), 6)};
      if (!intervals) continue;
      row.push_back(has_no_intervals(bars) ? "" : text::shortest(bars.low[g]));
      row.push_back(has_no_intervals(bars) ? "" : text::shortest(bars.high[g]));
    }
  }
  return table.text();
}

std::string bar_chart_script(const BarChart& chart) {
  std::ostringstream out;
  out.imbue(std::locale::classic());
  const auto groups = static_cast<double>(chart.groups.size());
  const double of_group = static_cast<double>(chart.series.size()) * bar_height + group_gap;
  const double left = label_room(chart);
  std::vector<Series> legend;
  for (const BarSeries& bars : chart.series) legend.push_back(legend_series(bars));
  const double height = title_height(chart.subtitle) + groups * of_group + PlotPage::bottom_margin;
  PlotPage page(out, left + bars_width + legend_width(legend), height);
  page.open(chart.name, chart.title, chart.subtitle);
  page.set_frame({.left = left,
                  .right = left + bars_width,
                  .bottom = PlotPage::bottom_margin,
                  .top = PlotPage::bottom_margin + groups * of_group});
  double least = 0., greatest = 1.;
  for (const BarSeries& bars : chart.series) {
    for (const auto* values : {&bars.values, &bars.low, &bars.high}) {
      for (const double value : *values) {
        least = std::min(least, value);
        greatest = std::max(greatest, value);
      }
    }
  }
  out << "set border 1 lw 1\nset xtics out nomirror scale 0.6\n"
      << "set grid xtics lc rgb '#dddddd' lw 0.7 lt 1\n"
      << "set xrange [" << text::shortest(least) << ":" << text::shortest(greatest) << "]\n"
      << "set yrange [" << text::shortest(0.5 - groups) << ":0.5]\n"
      << "set xlabel " << gnuplot_quoted(typeset(column_title(chart.value.label, chart.value.unit)))
      << " noenhanced\nset ytics scale 0 noenhanced (";
  for (std::size_t g = 0; g < chart.groups.size(); ++g)
    out << (g > 0 ? ", " : "") << gnuplot_quoted(chart.groups[g]) << " -" << g;
  out << ")\n";
  if (least < 0.) out << "set arrow from 0, graph 0 to 0, graph 1 nohead lc rgb '#999999' lw 0.8\n";
  double y = PlotPage::bottom_margin + groups * of_group - 0.5 * PlotPage::row_height;
  for (const Series& series : legend) {
    page.legend_entry(left + bars_width + PlotPage::lead, y, series);
    y -= PlotPage::row_height;
  }
  for (std::size_t s = 0; s < chart.series.size(); ++s) {
    const std::size_t first = s * chart.groups.size();
    const std::string rows = gnuplot_quoted(chart.name + ".csv") +
                             " skip 1 every ::" + std::to_string(first) +
                             "::" + std::to_string(first + chart.groups.size() - 1) + " using ";
    out << (s == 0 ? "plot \\\n  " : ", \\\n  ") << rows
        << "(0):4:3:(0) with vectors nohead lw 9 lc rgb '"
        << series_style(chart.series[s].style).color << "'";
    if (!has_no_intervals(chart.series[s]))
      out << ", \\\n  " << rows << "3:4:5:6 with xerrorbars pt -1 lw 1.2 lt 1 lc rgb '#333333'";
  }
  out << "\n";
  return out.str();
}

PlotOutcome draw(const BarChart& chart, const std::filesystem::path& folder) {
  return draw_files(chart.name, bar_chart_data(chart), bar_chart_script(chart), folder);
}

}  // namespace hookpoint::output
