#include <algorithm>
#include <cmath>
#include <locale>
#include <sstream>

#include "output/figures/plot_axes.h"
#include "output/figures/plot_legend.h"
#include "output/figures/plot_page.h"
#include "text/number.h"

namespace hookpoint::output {
namespace {

constexpr double width = 900.;  // of the drawing [px]

/// gnuplot drops the entries of a key that it deems too long, and cannot place them beside their
/// curves, so the legend is drawn entry by entry.
void write_legend(std::ostream& out, PlotPage& page, const Frame& frame, const Plot& plot,
                  const Layout& layout) {
  const double left = frame.right + PlotPage::lead;
  const LegendRoom room{frame.bottom, frame.top, PlotPage::row_height};
  for (const LegendEntry& entry : place_legend(plot, layout, room)) {
    const Series& series = plot.series[entry.series];
    if (entry.leads)
      out << "set arrow from first " << text::shortest(entry.end_x) << ", first "
          << text::shortest(entry.end_y) << " to " << page.at(left, entry.height)
          << " nohead lw 0.7 lc rgb '#90" << line_color(series).substr(1) << "'\n";
    page.legend_entry(left, entry.height, series);
  }
  page.legend_notes(left, frame.bottom - 14., notes_of(plot, layout));
}

}  // namespace

std::string plot_script(const Plot& plot) {
  std::ostringstream out;
  out.imbue(std::locale::classic());
  const Layout layout = lay_out(plot);
  const double entries = static_cast<double>(plot.series.size());
  const double height = std::max(520., std::ceil(PlotPage::row_height * entries) + 150.);
  const Frame frame{.left = PlotPage::left_margin,
                    .right = width - legend_width(plot.series),
                    .bottom = PlotPage::bottom_margin,
                    .top = height - title_height(plot.subtitle)};
  PlotPage page(out, width, height);
  page.open(plot.name, plot.title, plot.subtitle);
  page.set_frame(frame);
  write_legend(out, page, frame, plot, layout);
  write_axes(out, plot, layout, plot.name, 0, {});
  return out.str();
}

}  // namespace hookpoint::output
