#include "studies/compare/score_card.h"

#include <algorithm>
#include <cmath>
#include <numeric>

#include "studies/results/summary.h"
#include "text/number.h"

namespace hookpoint::studies {
namespace {

constexpr double tenth = 0.1;  // cells show a decade's tenths

bool is_ours(const SubjectInfo& subject) { return subject.engine == "dts"; }

/// Whether there was a run, which may have ended early.
bool ran(const WallCell& cell) {
  if (cell.status.empty()) return false;
  const RunOutcome outcome = outcome_of(cell.status);
  return outcome == RunOutcome::finished || outcome == RunOutcome::stopped;
}

/// No -0 among them.
double to_tenths(double decades) { return std::round(decades / tenth) * tenth + 0.; }

output::HeatMapCell card_cell(const WallCell& cell) {
  output::HeatMapCell shown;
  shown.run = ran(cell);
  if (shown.run && cell.decades) shown.value = to_tenths(*cell.decades);
  return shown;
}

/// Who accepts errors, each once.
std::vector<std::string> accepting(const WallResult& wall) {
  std::vector<std::string> names;
  for (const WallScene& scene : wall.scenes)
    if (scene.accepted && std::ranges::find(names, scene.accepted_by) == names.end())
      names.push_back(scene.accepted_by);
  return names;
}

output::HeatMapCell accepted_cell(const WallScene& scene, const WallLine& line,
                                  const std::string& by) {
  output::HeatMapCell shown;
  if (!scene.accepted || scene.accepted_by != by || !(line.scale > 0.)) return shown;
  shown.run = true;
  shown.value = to_tenths(std::log10(*scene.accepted / line.scale));
  return shown;
}

/// 0, 1, 2 ...: where names stand on an axis.
std::vector<double> places(std::size_t count) {
  std::vector<double> values(count);
  std::iota(values.begin(), values.end(), 0.);
  return values;
}

/// The truth's name; its scene's before it where that has several.
std::string line_name(const WallResult& wall, const WallLine& line) {
  const std::string& scene = wall.scenes[line.scene].name;
  return spoken(scene == line.name ? scene : scene + " " + line.name);
}

}  // namespace

output::HeatMap score_card(const WallResult& wall) {
  output::HeatMap map;
  map.name = score_card_name;
  map.title = "Decades of error";
  map.subtitle =
      "log10 of the error over the size of what is measured: -3 is a thousandth; at least -9";
  map.less_is_better = true;
  map.color = {.label = "decades of error", .unit = ""};
  const std::vector<std::string> others = accepting(wall);
  map.x = {.label = "subject", .unit = "", .names = others};
  for (const SubjectInfo& subject : wall.subjects) map.x.names.push_back(subject.name);
  map.y = {.label = "truth", .unit = ""};
  output::HeatMapPanel& panel = map.panels.emplace_back();
  for (auto line = wall.lines.rbegin(); line != wall.lines.rend(); ++line) {  // from the bottom
    map.y.names.push_back(line_name(wall, *line));
    for (const std::string& by : others)
      panel.cells.push_back(accepted_cell(wall.scenes[line->scene], *line, by));
    for (const WallCell& cell : line->cells) panel.cells.push_back(card_cell(cell));
  }
  map.x_values = places(map.x.names.size());
  map.y_values = places(map.y.names.size());
  return map;
}

std::vector<Loss> losses(const WallResult& wall) {
  std::vector<Loss> found;
  for (const WallLine& line : wall.lines) {
    Loss loss;
    loss.line = &line;
    std::optional<double> best;
    for (std::size_t i = 0; i < line.cells.size(); ++i) {
      const std::optional<double>& decades = line.cells[i].decades;
      if (is_ours(wall.subjects[i]) || !decades || (best && *best <= *decades)) continue;
      best = decades;
      loss.other = wall.subjects[i].name;
    }
    if (!best) continue;
    loss.theirs = *best;
    for (std::size_t i = 0; i < line.cells.size(); ++i) {
      const WallCell& cell = line.cells[i];
      if (!is_ours(wall.subjects[i]) || !ran(cell) || cell.ok) continue;
      if (!cell.decades || *cell.decades > *best + 1.)
        loss.ours.emplace_back(wall.subjects[i].name, cell.decades);
    }
    if (!loss.ours.empty()) found.push_back(std::move(loss));
  }
  return found;
}

output::CsvTable score_table(const WallResult& wall) {
  output::CsvTable table;
  table.header = {"scene",    "truth", "subject", "engine",  "measured",
                  "expected", "unit",  "scale",   "decades", "status"};
  for (const WallLine& line : wall.lines)
    for (std::size_t i = 0; i < line.cells.size(); ++i) {
      const WallCell& cell = line.cells[i];
      if (cell.status.empty()) continue;
      table.rows.push_back({wall.scenes[line.scene].name, line.name, wall.subjects[i].name,
                            wall.subjects[i].engine, text::shortest(cell.measured),
                            text::shortest(cell.expected), line.unit, text::shortest(line.scale),
                            text::shortest(cell.decades), cell.status});
    }
  return table;
}

output::LatexTable latex_score_table(const WallResult& wall) {
  output::LatexTable table{.name = score_table_name,
                           .label = score_table_name,
                           .caption =
                               "Decades of error: log10 of the error over the size of what "
                               "is measured. *: beyond what the truth allows.",
                           .across = "",
                           .head = {"truth"},
                           .text_columns = 1,
                           .rows = {}};
  for (const SubjectInfo& subject : wall.subjects)
    table.head.push_back(output::latex_text(subject.name));
  for (const WallLine& line : wall.lines) {
    table.rows.push_back({output::latex_text(line_name(wall, line))});
    for (const WallCell& cell : line.cells) {
      const bool shown = ran(cell) && cell.decades;
      table.rows.back().push_back(!shown ? "--"
                                         : output::latex_number(to_tenths(*cell.decades)) +
                                               (cell.ok ? "" : output::latex_star));
    }
  }
  return table;
}

}  // namespace hookpoint::studies
