// From a Plot block with a colour to a map: two sweeps, a panel a subject.
#include <algorithm>
#include <cmath>

#include "studies/figure_parts.h"
#include "studies/summary.h"

namespace hookpoint::studies {
namespace {

/// The values of a sweep that `where` lets in.
std::vector<double> drawn_values(const StudyResult& study, const PlotSpec& spec,
                                 const std::string& name) {
  for (const auto& [sweep, values] : spec.where)
    if (sweep == name) return values;
  const auto sweep = sweep_index(study, name);
  return sweep ? study.sweeps[*sweep].values : std::vector<double>{};
}

std::optional<std::size_t> place_of(const std::vector<double>& values, double value) {
  const auto found =
      std::find_if(values.begin(), values.end(), [&](double v) { return same(v, value); });
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

std::string caption_of(const PlotSpec& spec, const output::HeatMap& map) {
  std::string caption = map.title + (map.subtitle.empty() ? "." : " (" + map.subtitle + ").");
  caption += " Number and colour of a cell: " + map.color.label +
             (map.color.unit.empty() ? "" : " in " + map.color.unit) + ". Crosses: no value.";
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
  map.subtitle = fixed_text(study, spec);
  if (!undecided(study, spec).empty())
    map.subtitle += (map.subtitle.empty() ? "" : "; ") + ("largest over " + undecided(study, spec));
  map.x = {.label = spoken(spec.x), .unit = spec.x_unit};
  map.y = {.label = spoken(spec.y), .unit = spec.y_unit};
  map.color = {.label = spoken(spec.color), .unit = spec.color_unit};
  map.x_values = drawn_values(study, spec, spec.x);
  map.y_values = drawn_values(study, spec, spec.y);
  const auto x = sweep_index(study, spec.x), y = sweep_index(study, spec.y);
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
  figure.caption = caption_of(spec, map);
  return figure;
}

}  // namespace hookpoint::studies
