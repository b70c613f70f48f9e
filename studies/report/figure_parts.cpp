#include "studies/report/figure_parts.h"

#include <algorithm>
#include <cmath>

#include "studies/results/summary.h"
#include "text/number.h"

namespace hookpoint::studies {

bool selected(const StudyResult& study, const PlotSpec& spec, const RunResult& row) {
  if (!spec.subjects.empty() &&
      std::ranges::find(spec.subjects, row.subject) == spec.subjects.end())
    return false;
  return admits(study, spec.where, row);
}

std::string undecided_sweeps(const StudyResult& study, const PlotSpec& spec) {
  std::string names;
  for (const SweepColumn& sweep : study.sweeps) {
    const bool fixed = std::any_of(spec.where.begin(), spec.where.end(), [&](const auto& pair) {
      return pair.first == sweep.name && pair.second.size() == 1;
    });
    if (fixed || sweep.name == spec.x || sweep.name == spec.y || sweep.name == spec.series ||
        std::ranges::find(spec.panels, sweep.name) != spec.panels.end() || sweep.values.size() < 2)
      continue;
    names += (names.empty() ? "" : " and ") + spoken(sweep.name);
  }
  return names;
}

std::string fixed_values_text(const StudyResult& study, const PlotSpec& spec) {
  std::string text;
  for (const auto& [name, values] : spec.where) {
    const auto sweep = sweep_index(study, name);
    const bool panel = std::ranges::find(spec.panels, name) != spec.panels.end();
    if (name == spec.x || name == spec.y || panel) continue;
    text += (text.empty() ? "" : ", ") + spoken(name) + " = ";
    for (std::size_t i = 0; i < values.size(); ++i)
      text += (i > 0 ? " or " : "") +
              (sweep ? label_of(study.sweeps[*sweep], values[i]) : text::rounded(values[i], 6));
    if (sweep && !study.sweeps[*sweep].unit.empty()) text += " " + study.sweeps[*sweep].unit;
  }
  return text;
}

std::vector<double> drawn_values(const StudyResult& study, const PlotSpec& spec,
                                 const std::string& name) {
  for (const auto& [sweep, values] : spec.where)
    if (sweep == name) return values;
  const auto sweep = sweep_index(study, name);
  return sweep ? study.sweeps[*sweep].values : std::vector<double>{};
}

std::vector<PanelSpec> panel_specs(const StudyResult& study, const PlotSpec& spec) {
  std::vector<SweepValues> combinations = {{}};
  for (const std::string& sweep : spec.panels) {
    std::vector<SweepValues> extended;
    for (const SweepValues& outer : combinations) {
      for (const double value : drawn_values(study, spec, sweep)) {
        extended.push_back(outer);
        extended.back().emplace_back(sweep, std::vector{value});
      }
    }
    combinations = std::move(extended);
  }
  std::vector<PanelSpec> panels;
  for (const SweepValues& values : combinations) {
    PanelSpec panel{.spec = spec, .title = ""};
    panel.spec.where = values;
    panel.spec.panels.clear();
    panel.title = fixed_values_text(study, panel.spec);
    panel.spec.where.insert(panel.spec.where.end(), spec.where.begin(), spec.where.end());
    panels.push_back(std::move(panel));
  }
  return panels;
}

}  // namespace hookpoint::studies
