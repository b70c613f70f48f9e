// From a Plot block with a colour to a map: two sweeps, a panel a subject.
#include <algorithm>
#include <cctype>
#include <cmath>

#include "studies/report/figure_parts.h"
#include "studies/results/summary.h"

namespace hookpoint::studies {
namespace {

std::optional<std::size_t> place_of(const std::vector<double>& values, double value) {
  const auto found =
      std::find_if(values.begin(), values.end(), [&](double v) { return same_value(v, value); });
  if (found == values.end()) return {};
  return static_cast<std::size_t>(found - values.begin());
}

void fill_cell(output::HeatMapCell& cell, const RunResult& row, std::size_t color,
               std::optional<std::size_t> outline) {
  if (outcome_of(row) == RunOutcome::skipped || outcome_of(row) == RunOutcome::refused) return;
  cell.run = true;
  const std::optional<double>& value = row.metrics[color].measured;
  const bool larger = value && (!cell.value || std::abs(*value) > std::abs(*cell.value));
  if (larger && std::isfinite(*value)) cell.value = value;
  if (outline) cell.predicted = row.metrics[*outline].predicted;
}

/// Where a logarithmic scale of colours begins: what is smaller counts as rounding.
constexpr double least_drawn = 1e-9;

/// Whether a prefix before the unit scales it: "m/s" and "rad", not "m^2", "1/s" or "kg".
bool takes_prefix(const std::string& unit) {
  const std::string first = unit.substr(0, unit.find('/'));
  return !first.empty() && first != "kg" && std::ranges::all_of(first, [](char c) {
    return std::isalpha(static_cast<unsigned char>(c));
  });
}

/// Numbers too small to be read in a cell get a unit with a prefix: 5e-05 rad is 50 urad, and
/// -0.0123 rad among others is -12.3 mrad.
void prefix_unit(output::HeatMap& map) {
  double least = 1., greatest = 0.;
  for (const output::HeatMapPanel& panel : map.panels) {
    for (const output::HeatMapCell& cell : panel.cells) {
      const double magnitude = std::abs(cell.value.value_or(0.));
      greatest = std::max(greatest, magnitude);
      if (magnitude > 0.) least = std::min(least, magnitude);
    }
  }
  const bool long_digits = greatest > 0. && greatest < 1. && least < 0.1;
  if (!takes_prefix(map.color.unit) || !long_digits) return;
  const bool micro = greatest < 1e-4;
  map.color.unit = (micro ? "u" : "m") + map.color.unit;
  for (output::HeatMapPanel& panel : map.panels)
    for (output::HeatMapCell& cell : panel.cells)
      if (cell.value) *cell.value *= micro ? 1e6 : 1e3;
}

std::string caption_of(const PlotSpec& spec, const output::HeatMap& map) {
  std::string caption = map.title + (map.subtitle.empty() ? "." : " (" + map.subtitle + ").");
  const bool colors_alone = output::crowded(map);
  caption += (colors_alone ? " Colour of a cell: " : " Number and colour of a cell: ") +
             map.color.label + (map.color.unit.empty() ? "" : " in " + map.color.unit) +
             (colors_alone ? ". White: no value." : ". Crosses: no value.");
  if (!spec.outline.empty())
    caption += " Dashed: where the closed form of " + spoken(spec.outline) + " changes.";
  return caption;
}

}  // namespace

Figure make_map(const StudyResult& study, const PlotSpec& spec) {
  Figure figure;
  output::HeatMap& map = figure.map.emplace();
  figure.plot.name = map.name = spec.name;
  map.title = spec.title.empty() ? spoken(spec.color) : spec.title;
  map.subtitle = fixed_values_text(study, spec);
  if (!undecided_sweeps(study, spec).empty())
    map.subtitle +=
        (map.subtitle.empty() ? "" : "; ") + ("largest over " + undecided_sweeps(study, spec));
  map.x = {.label = spoken(spec.x), .unit = spec.x_unit};
  map.y = {.label = spoken(spec.y), .unit = spec.y_unit};
  const auto x = sweep_index(study, spec.x), y = sweep_index(study, spec.y);
  map.x.names = study.sweeps[x.value()].words;
  map.y.names = study.sweeps[y.value()].words;
  map.color = {.label = spoken(spec.color),
               .unit = spec.color_unit,
               .logarithmic = spec.log_y,
               .floor = least_drawn};
  map.x_values = drawn_values(study, spec, spec.x);
  map.y_values = drawn_values(study, spec, spec.y);
  const auto color = metric_index(study, spec.color), outline = metric_index(study, spec.outline);
  for (std::size_t subject = 0; subject < study.subjects.size(); ++subject) {
    output::HeatMapPanel panel;
    panel.title = spoken(study.subjects[subject].name);
    panel.cells.resize(map.x_values.size() * map.y_values.size());
    for (const RunResult& row : study.rows) {
      if (row.subject != static_cast<int>(subject) || !selected(study, spec, row) || !color)
        continue;
      const auto column = place_of(map.x_values, row.parameters[*x]);
      const auto line = place_of(map.y_values, row.parameters[*y]);
      if (column && line)
        fill_cell(panel.cells[*line * map.x_values.size() + *column], row, *color, outline);
    }
    const bool any = std::any_of(panel.cells.begin(), panel.cells.end(),
                                 [](const output::HeatMapCell& cell) { return cell.run; });
    if (any) map.panels.push_back(std::move(panel));
  }
  if (!map.color.logarithmic) prefix_unit(map);
  figure.caption = caption_of(spec, map);
  return figure;
}

}  // namespace hookpoint::studies
