#include "output/figures/plot.h"

#include <algorithm>
#include <cassert>
#include <cmath>
#include <utility>

#include "output/files/child.h"
#include "output/files/csv.h"
#include "output/files/file.h"
#include "text/number.h"

namespace hookpoint::output {
namespace {

/// gnuplot takes `<name` and `|name` for commands.
bool names_a_file(const std::string& name) {
  return !name.empty() && name.find_first_of("/<|") == std::string::npos && one_line(name) == name;
}

/// Whether some points have bars: every row has a column for them then.
bool has_bars(const Plot& plot) {
  return std::ranges::any_of(plot.series,
                             [](const Series& series) { return !series.half_widths.empty(); });
}

void add_rows(CsvTable& table, const std::string& series, const char* kind, const Axis& axis,
              const std::vector<double>& x, const std::vector<double>* y,
              const std::vector<double>* half_widths) {
  for (std::size_t i = 0; i < x.size(); ++i) {
    table.rows.push_back(
        {series, kind, text::shortest(x[i]), y == nullptr ? "" : text::shortest((*y)[i])});
    if (half_widths != nullptr)
      table.rows.back().push_back(half_widths->empty() ? "" : text::shortest((*half_widths)[i]));
    if (!axis.names.empty())
      table.rows.back().push_back(axis.names.at(static_cast<std::size_t>(std::lround(x[i]))));
  }
}

std::vector<std::string> header_of(const Plot& plot, bool bars) {
  std::vector<std::string> header{"series", "kind", column_title(plot.x.label, plot.x.unit),
                                  column_title(plot.y.label, plot.y.unit)};
  if (bars) header.push_back(column_title("half_width", plot.y.unit));
  if (!plot.x.names.empty()) header.push_back(plot.x.label + " name");
  return header;
}

void add_curves(CsvTable& table, const Plot& plot, bool bars) {
  static const std::vector<double> none;
  const std::vector<double>* no_bars = bars ? &none : nullptr;
  for (const Series& series : plot.series) {
    assert(series.measured.x.size() == series.measured.y.size());
    assert(series.predicted.x.size() == series.predicted.y.size());
    const char* line = series.reference ? "reference" : "predicted";
    add_rows(table, series.label, "measured", plot.x, series.measured.x, &series.measured.y,
             bars ? &series.half_widths : nullptr);
    add_rows(table, series.label, line, plot.x, series.predicted.x, &series.predicted.y, no_bars);
    add_rows(table, series.label, "unfinished", plot.x, series.unfinished, nullptr, no_bars);
  }
}

}  // namespace

std::string plot_data(const Plot& plot) {
  CsvTable table;
  table.header = header_of(plot, has_bars(plot));
  add_curves(table, plot, has_bars(plot));
  return table.text();
}

std::string panel_data(const PanelPlot& plot) {
  CsvTable table;
  const bool bars = std::ranges::any_of(plot.panels, has_bars);
  table.header = header_of(plot.panels.front(), bars);
  table.header.emplace_back("panel");
  for (const Plot& panel : plot.panels) {
    const std::size_t first = table.rows.size();
    add_curves(table, panel, bars);
    for (std::size_t i = first; i < table.rows.size(); ++i) table.rows[i].push_back(panel.title);
  }
  return table.text();
}

PlotOutcome draw(const Plot& plot, const std::filesystem::path& folder) {
  return draw_files(plot.name, plot_data(plot), plot_script(plot), folder);
}

PlotOutcome draw(const PanelPlot& plot, const std::filesystem::path& folder) {
  return draw_files(plot.name, panel_data(plot), panel_script(plot), folder);
}

GnuplotOutcome run_gnuplot(const std::filesystem::path& folder, const std::string& script,
                           const std::string& drawing) {
  const std::filesystem::path file = folder / drawing;
  std::error_code ignored;
  std::filesystem::remove(file, ignored);
  const std::optional<ChildResult> run =
      run_program("gnuplot", {"--default-settings", script}, folder);
  if (!run)
    return {"", "gnuplot is not installed (Debian: gnuplot-nox), so " + drawing +
                    " was not drawn; its data and script are in " + folder.string()};
  std::string bytes = run->status == 0 ? read_file(file).value_or("") : "";
  if (!bytes.empty()) return {std::move(bytes), ""};
  std::filesystem::remove(file, ignored);
  if (run->status != 0) return {"", "gnuplot could not draw " + file.string() + ": " + run->output};
  return {"", "gnuplot drew nothing into " + file.string() + ": the figure has no point"};
}

PlotOutcome draw_files(const std::string& name, const std::string& data, const std::string& script,
                       const std::filesystem::path& folder) {
  if (!names_a_file(name)) throw FileError("`" + one_line(name) + "` is no name of a figure");
  write_file(folder / (name + ".csv"), data);
  write_file(folder / (name + ".gp"), script);
  GnuplotOutcome outcome = run_gnuplot(folder, name + ".gp", name + ".svg");
  return {.drawn = !outcome.drawing.empty(),
          .message = std::move(outcome.message),
          .svg = std::move(outcome.drawing)};
}

}  // namespace hookpoint::output
