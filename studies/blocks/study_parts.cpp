#include "studies/blocks/study_parts.h"

#include <algorithm>
#include <utility>

#include "studies/blocks/block.h"

namespace hookpoint::studies {

std::vector<std::string> StudyParts::parameters() const {
  std::vector<std::string> names = scene_parameters;
  for (const SweptGround& ground : grounds)
    names.insert(names.end(), ground.parameters.begin(), ground.parameters.end());
  return names;
}

std::vector<std::string> StudyParts::sweep_names() const {
  std::vector<std::string> names;
  for (const SweepPlan& sweep : sweeps) names.push_back(sweep.column.name);
  return names;
}

int StudyParts::sweep_index(std::string_view sweep) const {
  const auto found = std::ranges::find_if(
      sweeps, [&](const SweepPlan& other) { return other.column.name == sweep; });
  return found == sweeps.end() ? -1 : static_cast<int>(found - sweeps.begin());
}

std::vector<std::string> StudyParts::subject_names() const {
  std::vector<std::string> names;
  for (const SubjectPlan& subject : subjects) names.push_back(subject.info.name);
  return names;
}

std::vector<const MetricDefinition*> StudyParts::metric_definitions() const {
  std::vector<const MetricDefinition*> definitions;
  for (const MeasuredMetric& metric : metrics) definitions.push_back(metric.definition);
  return definitions;
}

std::vector<std::string> StudyParts::metric_names() const {
  std::vector<std::string> names;
  for (const MeasuredMetric& metric : metrics) names.emplace_back(metric.definition->name);
  return names;
}

std::ptrdiff_t StudyParts::metric_index(std::string_view metric) const {
  const auto found = std::ranges::find(
      metrics, metric, [](const MeasuredMetric& measured) { return measured.definition->name; });
  return found == metrics.end() ? -1 : found - metrics.begin();
}

bool StudyParts::is_varied(const std::string& parameter) const {
  return sweep_index(parameter) >= 0 || std::ranges::any_of(sweeps, [&](const SweepPlan& sweep) {
           return sweep.assigns(parameter);
         });
}

int StudyParts::seed_sweep() const {
  const bool has_seeds = !sweeps.empty() && sweeps.back().role == SweepRole::seeds;
  return has_seeds ? static_cast<int>(sweeps.size()) - 1 : -1;
}

int StudyParts::case_sweep() const {
  const auto found = std::ranges::find(sweeps, SweepRole::cases, &SweepPlan::role);
  return found == sweeps.end() ? -1 : static_cast<int>(found - sweeps.begin());
}

SweepValues StudyParts::admitted(const std::vector<Condition>& conditions) const {
  SweepValues values;
  for (const Condition& condition : conditions) {
    const SweepPlan& sweep = sweeps[static_cast<std::size_t>(condition.sweep)];
    std::vector<double> held;
    for (std::size_t i = 0; i < sweep.si.size(); ++i)
      if (condition.holds(sweep.si[i])) held.push_back(sweep.column.values[i]);
    values.emplace_back(sweep.column.name, std::move(held));
  }
  return values;
}

std::vector<std::string> metric_names() {
  std::vector<std::string> names;
  for (const MetricDefinition& metric : metric_table()) names.emplace_back(metric.name);
  return names;
}

std::string metric_unit(const Placed<std::string>& metric, const StudyParts& so_far,
                        language::Diagnostics& diagnostics) {
  const std::ptrdiff_t index = so_far.metric_index(*metric);
  if (index >= 0) return so_far.metrics[static_cast<std::size_t>(index)].unit.text;
  std::vector<std::string> known = metric_names();
  append(known, so_far.metric_names());
  report_unknown(metric.position(), "Measure of this study", *metric, known, diagnostics);
  return "";
}

}  // namespace hookpoint::studies
