#include "studies/plan/row_forms.h"

#include <algorithm>
#include <cmath>
#include <string>
#include <utility>
#include <vector>

#include "simulation/closed_form.h"
#include "studies/plan/scene_probe.h"
#include "studies/plan/scene_words.h"

namespace hookpoint::studies {
namespace {

simulation::ClosedForm<double> value_of(const language::Formula& formula, SceneNames& names) {
  std::vector<double> values;
  std::string why;
  const auto say_why = [&](std::size_t, const std::string& reason) {
    if (why.empty()) why = reason;
  };
  for (const auto& number : names.numbers(formula, say_why)) {
    if (!number) return simulation::NoClosedForm{std::move(why)};
    values.push_back(number->value);
  }
  const double value = language::FormulaEvaluator(formula)(values);
  if (!std::isfinite(value))
    return simulation::NoClosedForm{"`" + formula.text + "` is no finite number here"};
  return value;
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
  if (metric.predicted == nullptr) {
    form.no_form = "the Measure has no `predicted`";
    return form;
  }
  const auto value = value_of(*metric.predicted, names);
  if (value)
    form.predicted = metric.in_unit(*value);
  else
    form.no_form = value.why();
  return form;
}

RowForm form_of_expectation(const UserMetric& metric, const simulation::Experiment& experiment) {
  const auto* spec = expectation_of(experiment, metric.expectation);
  RowForm form;
  if (spec == nullptr) {
    form.no_form = "the Expect does not cover the run's law and integrator";
    return form;
  }
  form.predicted = spec->expected;
  form.allowed = std::max(spec->within, spec->tolerance * std::abs(spec->expected));
  return form;
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
