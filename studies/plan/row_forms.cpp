#include "studies/plan/row_forms.h"

#include <algorithm>
#include <cmath>
#include <optional>
#include <string>

#include "studies/plan/scene_probe.h"
#include "studies/plan/scene_words.h"

namespace hookpoint::studies {
namespace {

std::optional<double> value_of(const language::Formula& formula, SceneNames& names) {
  std::vector<double> values;
  for (const auto& number : names.numbers(formula)) {
    if (!number) return std::nullopt;
    values.push_back(number->value);
  }
  const double value = language::FormulaEvaluator(formula)(values);
  return std::isfinite(value) ? std::optional(value) : std::nullopt;
}

/// Names of the ports that a metric of the study's own is of, as the study writes them.
const std::vector<std::string>& ports_of(const StudyPlan& plan, const UserMetric& metric) {
  if (metric.of != nullptr) return metric.of->names;
  return std::ranges::find(plan.curves, metric.trace, &MeasuredCurves::name)->ports;
}

RowForm form_of_own(const StudyPlan& plan, const UserMetric& metric, SceneNames& names,
                    const simulation::Experiment& experiment) {
  RowForm form;
  for (const std::string& name : ports_of(plan, metric)) {
    std::string why;
    const auto port = names.port(name, why, &experiment);
    if (form.missing.empty()) form.missing = port ? port->missing : why;
  }
  if (metric.predicted == nullptr) return form;
  if (const auto value = value_of(*metric.predicted, names))
    form.predicted = metric.in_unit(*value);
  return form;
}

RowForm form_of_expectation(const UserMetric& metric, const simulation::Experiment& experiment) {
  const auto* spec = expectation_of(experiment, metric.expectation);
  if (spec == nullptr) return {};
  return {spec->expected, std::max(spec->within, spec->tolerance * std::abs(spec->expected)), ""};
}

}  // namespace

std::vector<RowForm> row_forms(const StudyPlan& plan, const RowPlan& row,
                               const language::Object& tree,
                               const simulation::Experiment& experiment) {
  std::vector<RowForm> forms;
  if (plan.user_metrics.empty()) return forms;
  SceneNames names(tree, words_of(plan, row), &experiment);
  for (const auto& metric : plan.user_metrics)
    forms.push_back(metric->expectation.empty() ? form_of_own(plan, *metric, names, experiment)
                                                : form_of_expectation(*metric, experiment));
  return forms;
}

}  // namespace hookpoint::studies
