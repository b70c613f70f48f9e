#include "studies/plan/row_forms.h"

#include <algorithm>
#include <cctype>
#include <cmath>
#include <optional>
#include <string>
#include <string_view>
#include <utility>
#include <vector>

#include "language/syntax/syntax.h"
#include "simulation/experiment/closed_form.h"
#include "studies/measure/scene_names.h"

namespace hookpoint::studies {
namespace {

bool is_word(std::string_view text) {
  const auto part_of_word = [](unsigned char c) { return std::isalnum(c) != 0 || c == '_'; };
  if (text.empty() || std::isdigit(static_cast<unsigned char>(text.front())) != 0) return false;
  return std::ranges::all_of(text, part_of_word) && text != "true" && text != "false" &&
         text != "pi";
}

/// Adds the words that Params of `file` hold, some of which are given.
void add_words(SceneWords& words, language::Library& library, const std::filesystem::path& file,
               const std::map<std::string, std::string>& given) {
  language::Diagnostics unreported;
  const auto declared = library.parameters(file, unreported);
  for (const language::ParameterDeclaration& parameter : declared) {
    const auto set = given.find(parameter.name);
    const std::string& text = set == given.end() ? parameter.default_text : set->second;
    if (is_string(text)) {
      words.try_emplace(parameter.name, language::unquote(text));
      continue;
    }
    if (!is_word(text)) continue;
    // In the file itself the name of a Param means what that holds.
    const bool names_another =
        set == given.end() &&
        std::ranges::find(declared, text, &language::ParameterDeclaration::name) != declared.end();
    if (!names_another)
      words.try_emplace(parameter.name, text);
    else if (const auto other = words.find(text); other != words.end())
      words.try_emplace(parameter.name, other->second);
  }
}

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

SceneWords words_of(const StudyPlan& plan, const RowPlan& row) {
  SceneWords words;
  for (std::size_t i = 0; i < plan.sweeps.size(); ++i) {
    const SweepColumn& column = plan.sweeps[i].column;
    if (!column.words.empty())
      words[column.name] = column.words[static_cast<std::size_t>(row.values[i])];
  }
  const ScenePlan scene = plan.scene_of(row);
  add_words(words, *plan.library, scene.file, scene.options.parameters);
  if (scene.ground) add_words(words, *plan.library, scene.ground->file, scene.ground->parameters);
  return words;
}

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
