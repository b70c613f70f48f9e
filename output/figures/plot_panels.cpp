// Small multiples: a page, its panels row by row from the top, one legend.
#include <algorithm>
#include <locale>
#include <sstream>

#include "output/figures/plot_axes.h"
#include "output/figures/plot_page.h"
#include "text/number.h"

namespace hookpoint::output {
namespace {

constexpr double panel_width = 330., least_height = 236.;  // of the axes [px]
constexpr double gap_across = 70.;                         // for the tick labels of the next panel
constexpr double gap_down = 66.;                           // for tick labels and the next title
constexpr double title_gap = 14.;                          // from the axes to the panel's title
constexpr double notes_height = 60.;                       // below the legend's names

void append(Curve& curve, const Curve& more) {
  curve.x.insert(curve.x.end(), more.x.begin(), more.x.end());
  curve.y.insert(curve.y.end(), more.y.begin(), more.y.end());
}

/// All panels in one: what axes that they share have to hold.
Plot merged(const PanelPlot& plot) {
  Plot all = plot.panels.front();
  for (std::size_t i = 1; i < plot.panels.size(); ++i) {
    for (std::size_t k = 0; k < all.series.size(); ++k) {
      const Series& more = plot.panels[i].series[k];
      append(all.series[k].measured, more.measured);
      append(all.series[k].predicted, more.predicted);
      all.series[k].unfinished.insert(all.series[k].unfinished.end(), more.unfinished.begin(),
                                      more.unfinished.end());
    }
  }
  return all;
}

class PanelScript {
 public:
  explicit PanelScript(const PanelPlot& plot)
      : plot_(plot),
        all_(merged(plot)),
        shared_(lay_out(all_)),
        across_(std::min(plot.across, plot.panels.size())),
        down_((plot.panels.size() + across_ - 1) / across_),
        panel_height_(height_of(all_.series.size(), down_)),
        width_(frame_of(across_ - 1).right + legend_width(all_.series)),
        height_(frame_of(0).top + 2. * title_gap + title_height(plot.subtitle)),
        page_(out_, width_, height_) {
    out_.imbue(std::locale::classic());
  }

  std::string text() {
    page_.open(plot_.name, plot_.title, plot_.subtitle);
    out_ << "set multiplot\n";
    Notes notes;
    for (std::size_t i = 0; i < plot_.panels.size(); ++i)
      notes = notes | notes_of(plot_.panels[i], layout_of(i));
    write_legend(notes);
    std::size_t row = 0;
    for (std::size_t i = 0; i < plot_.panels.size(); ++i) row = write_panel(i, row);
    out_ << "unset multiplot\n";
    return out_.str();
  }

 private:
  /// So high that the legend, too, has room beside the panels.
  static double height_of(std::size_t series, std::size_t down) {
    const double legend = PlotPage::row_height * static_cast<double>(series) + notes_height;
    return std::max(least_height, legend / static_cast<double>(down));
  }

  Frame frame_of(std::size_t index) const {
    const std::size_t row = index / across_;
    const auto column = static_cast<double>(index % across_);
    const auto below = static_cast<double>(down_ - 1 - row);
    const double left = PlotPage::left_margin + column * (panel_width + gap_across);
    const double bottom = PlotPage::bottom_margin + below * (panel_height_ + gap_down);
    return {
        .left = left, .right = left + panel_width, .bottom = bottom, .top = bottom + panel_height_};
  }

  Layout layout_of(std::size_t index) const {
    if (!plot_.own_axes) return shared_;
    Layout layout = lay_out(plot_.panels[index]);
    layout.x = shared_.x;
    return layout;
  }

  /// Names stand in their own order: no order follows the curves' ends in all panels.
  void write_legend(const Notes& notes) {
    const Frame frame = frame_of(across_ - 1);
    const double left = frame.right + PlotPage::lead;
    double height = frame.top - 0.5 * PlotPage::row_height;
    std::vector<std::string> named;
    for (const Series& series : all_.series) {
      if (std::ranges::find(named, series.label) != named.end()) continue;
      named.push_back(series.label);
      page_.legend_entry(left, height, series);
      height -= PlotPage::row_height;
    }
    page_.legend_notes(left, height - 0.5 * PlotPage::row_height, notes);
  }

  std::size_t write_panel(std::size_t index, std::size_t first_row) {
    const Plot& panel = plot_.panels[index];
    const Frame frame = frame_of(index);
    page_.set_frame(frame);
    page_.text(frame.left, frame.top + title_gap, panel.title, "font 'Helvetica,13' noenhanced");
    const bool lowest = index + across_ >= plot_.panels.size();
    const std::size_t next = write_axes(out_, panel, layout_of(index), plot_.name, first_row,
                                        {.x = lowest, .y = index % across_ == 0});
    out_ << "unset label\nunset arrow\nunset object\n";
    return next;
  }

  const PanelPlot& plot_;
  Plot all_;
  Layout shared_;
  std::size_t across_, down_;  // panels in a row, rows of panels
  double panel_height_;        // of the axes [px]
  double width_, height_;      // of the drawing [px]
  std::ostringstream out_;
  PlotPage page_;
};

}  // namespace

std::string panel_script(const PanelPlot& plot) { return PanelScript(plot).text(); }

}  // namespace hookpoint::output
