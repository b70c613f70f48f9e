#include "studies/plan/plan_parts.h"

#include <fmt/format.h>

#include <algorithm>

#include "language/names.h"
#include "language/values/budget.h"
#include "output/text/number.h"
#include "studies/plan/plan_builder.h"
#include "studies/plan/plan_values.h"

namespace hookpoint::studies {
namespace {

using language::Diagnostics;
using language::Field;
using language::Object;

std::vector<double> in_unit(const std::vector<double>& si, const WrittenUnit& unit) {
  std::vector<double> values;
  for (const double value : si) values.push_back(tidy(unit.from_si(value)));
  return values;
}

}  // namespace

void PlanBuilder::unknown(const language::Position& position, std::string_view kind,
                          const std::string& name, const std::vector<std::string>& known) {
  diagnostics_.error(position, fmt::format("no {} is called `{}`{}", kind, name,
                                           language::did_you_mean(name, known)));
}

std::vector<std::string> PlanBuilder::sweep_names() const {
  std::vector<std::string> names;
  for (const SweepPlan& sweep : plan_.sweeps) names.push_back(sweep.column.name);
  return names;
}

int PlanBuilder::sweep_index(const std::string& name) const {
  const auto names = sweep_names();
  const auto found = std::find(names.begin(), names.end(), name);
  return found == names.end() ? -1 : static_cast<int>(found - names.begin());
}

bool PlanBuilder::parameter_exists(const Object& block) {
  if (std::find(parameters_.begin(), parameters_.end(), block.name) != parameters_.end())
    return true;
  unknown(block.position, "Param of the scene", block.name, parameters_);
  return false;
}

bool PlanBuilder::may_have_values(const Object& block, const char* field, double count) {
  if (count <= static_cast<double>(most_runs)) return true;
  diagnostics_.error(
      block.find(field)->position,
      fmt::format("the Sweep asks for {}", language::too_many(count, most_runs, "values")));
  return false;
}

void PlanBuilder::check_size(const Object& study) {
  auto count = static_cast<double>(plan_.subjects.size());
  for (const SweepPlan& sweep : plan_.sweeps) count *= static_cast<double>(sweep.si.size());
  if (count > static_cast<double>(most_runs))
    diagnostics_.error(study.position, fmt::format("the study's sweeps and subjects ask for {}",
                                                   language::too_many(count, most_runs, "runs")));
}

std::vector<double> PlanBuilder::sweep_values(const Object& block, const WrittenUnit& unit) {
  if (options_.quick && block.find("quick_values") != nullptr)
    return in_unit(block.numbers("quick_values"), unit);
  std::vector<double> values;
  if (block.find("values") != nullptr) {
    values = in_unit(block.numbers("values"), unit);
  } else if (block.find("from") != nullptr && block.find("to") != nullptr) {
    const double from = unit.from_si(block.number("from")), to = unit.from_si(block.number("to"));
    const bool logarithmic = block.word("scale") == "log";
    if (block.find("step") != nullptr && block.number("step") > 0. && to >= from) {
      const double step = unit.from_si(block.number("step"));
      if (!may_have_values(block, "step", stepped_count(from, to, step))) return {};
      values = stepped(from, to, step);
    } else if (block.find("count") != nullptr && (!logarithmic || (from > 0. && to > 0.))) {
      const double count = block.number("count");
      if (!may_have_values(block, "count", count)) return {};
      values = spaced(from, to, static_cast<int>(count), logarithmic);
    }
  }
  if (values.empty())
    diagnostics_.error(block.position,
                       "a Sweep needs `values`, or `from`, `to` and a `step` > 0 (or a "
                       "`count`; on a log scale both ends > 0)");
  if (options_.quick && values.size() > 2) return {values.front(), values.back()};
  return values;
}

void PlanBuilder::add_sweep(const Object& block) {
  if (!parameter_exists(block)) return;
  const Field* first = block.find("values") != nullptr ? block.find("values") : block.find("from");
  const WrittenUnit unit = first == nullptr ? WrittenUnit{} : written_unit(*first);
  SweepPlan sweep;
  sweep.column = {block.name, unit.text, sweep_values(block, unit)};
  for (const double value : sweep.column.values) {
    sweep.si.push_back(unit.to_si(value));
    sweep.texts.push_back(unit.with_unit(value));
  }
  plan_.sweeps.push_back(std::move(sweep));
}

std::vector<Assignment> PlanBuilder::fixes(const Object& owner) {
  std::vector<Assignment> result;
  for (const Object* block : owner.children_of("Fix")) {
    if (!parameter_exists(*block)) continue;
    if (sweep_index(block->name) >= 0) {
      diagnostics_.error(block->position,
                         fmt::format("`{}` is swept: it cannot be fixed as well", block->name));
      continue;
    }
    result.push_back({block->name, text_of(*block->find("value"))});
  }
  return result;
}

std::vector<Condition> PlanBuilder::conditions(const Object& owner) {
  std::vector<Condition> result;
  for (const Object* block : owner.children_of("Only")) {
    Condition condition;
    condition.sweep = sweep_index(block->name);
    if (condition.sweep < 0) {
      unknown(block->position, "Sweep", block->name, sweep_names());
      continue;
    }
    if (block->find("values") != nullptr) condition.values = block->numbers("values");
    if (block->find("from") != nullptr) condition.from = block->number("from");
    if (block->find("to") != nullptr) condition.to = block->number("to");
    result.push_back(std::move(condition));
  }
  return result;
}

void PlanBuilder::add_subject(const Object& block) {
  SubjectPlan subject = subject_of(block);
  if (!subject.engine.empty() && subject.engine != "dts" && !subject.contact.empty())
    diagnostics_.error(
        block.find("contact")->position,
        fmt::format("engine {} has a contact of its own: leave `contact` out", subject.engine));
  subject.fixes = fixes(block);
  subject.only = conditions(block);
  plan_.subjects.push_back(std::move(subject));
}

std::vector<std::string> PlanBuilder::metric_names() {
  std::vector<std::string> names;
  for (const MetricDefinition& metric : metric_table()) names.emplace_back(metric.name);
  return names;
}

double PlanBuilder::number_in(const Object& block, const char* field, std::string_view unit) {
  const Field& given = *block.find(field);
  const std::optional<language::Unit> expected = language::parse_unit(unit);
  if (expected && !language::fits(given.dimension, expected->dimension))
    diagnostics_.error(given.position,
                       fmt::format("`{}` is in {}, not {}", field,
                                   language::describe_dimension(expected->dimension),
                                   language::describe_dimension(given.dimension)));
  return block.number(field);
}

void PlanBuilder::add_metric(const Object& block) {
  const MetricDefinition* metric = find_metric(block.name);
  if (metric == nullptr) return unknown(block.position, "metric", block.name, metric_names());
  const Field* over = block.find("over");
  int sweep = -1;
  if (metric->scope == MetricScope::sweep) {
    sweep = sweep_index(over != nullptr ? block.word("over") : "azimuth");
    if (sweep < 0 && over != nullptr)
      unknown(over->position, "Sweep", block.word("over"), sweep_names());
    else if (sweep < 0)
      diagnostics_.warning(block.position,
                           fmt::format("`{}` says nothing: no Sweep is called azimuth, and `over` "
                                       "names no other",
                                       block.name));
  } else if (over != nullptr) {
    diagnostics_.error(over->position,
                       fmt::format("`{}` is of one run, not over a Sweep", block.name));
  }
  plan_.metrics.push_back(metric);
  plan_.metric_sweeps.push_back(sweep);
}

/// ", mu = 0.8, slope from 15 deg".
std::string PlanBuilder::conditions_words(const std::vector<Condition>& conditions) const {
  std::string words;
  for (const Condition& condition : conditions) {
    const SweepPlan& sweep = plan_.sweeps[static_cast<std::size_t>(condition.sweep)];
    std::vector<std::string> held;
    for (std::size_t i = 0; i < sweep.si.size(); ++i)
      if (condition.holds(sweep.si[i])) held.push_back(sweep.texts[i]);
    const bool all_given = held.size() < 3 || !condition.values.empty();
    words += ", " + sweep.column.name +
             (all_given ? " = " + language::join(held, " or ")
                        : " from " + held.front() + " to " + held.back());
  }
  return words;
}

std::string PlanBuilder::truth_words(const Object& block, const TruthPlan& truth) {
  const MetricDefinition& metric = *plan_.metrics[truth.metric];
  const std::string unit = metric.unit.empty() ? "" : " " + std::string(metric.unit);
  const auto number = [&](double value) { return output::shortest(tidy(value)) + unit; };
  std::string words(metric.name);
  if (truth.predicted) words += " equals predicted";
  if (truth.value) words += " equals " + number(*truth.value);
  if (truth.same_over >= 0)
    words +=
        " is the same over " + plan_.sweeps[static_cast<std::size_t>(truth.same_over)].column.name;
  if (truth.tolerance > 0.)
    words += " within " + output::shortest(tidy(100. * truth.tolerance)) + " %";
  if (truth.within > 0.)
    words += (truth.tolerance > 0. ? " or " : " within ") + number(truth.within);
  if (truth.above) words += " is above " + number(*truth.above);
  if (truth.below) words += " is below " + number(*truth.below);
  words += conditions_words(truth.only);
  if (block.find("subjects") != nullptr)
    words += " (" + language::join(block.find("subjects")->words, ", ") + ")";
  return words;
}

void PlanBuilder::add_truth(const Object& block) {
  TruthPlan truth;
  const std::string metric = block.find("metric") != nullptr ? block.word("metric") : block.name;
  std::vector<std::string> measured;
  for (const MetricDefinition* definition : plan_.metrics) measured.emplace_back(definition->name);
  const auto found = std::find(measured.begin(), measured.end(), metric);
  if (found == measured.end()) {
    unknown(block.position, "Measure of this study", metric, measured);
    return;
  }
  truth.metric = static_cast<std::size_t>(found - measured.begin());
  const std::string_view unit = plan_.metrics[truth.metric]->unit;
  const auto number = [&](const char* field) {
    return block.find(field) == nullptr ? std::nullopt
                                        : std::optional(number_in(block, field, unit));
  };
  truth.value = number("value");
  truth.above = number("above");
  truth.below = number("below");
  truth.within = number("within").value_or(0.);
  truth.tolerance = block.number("tolerance");
  if (block.find("same_over") != nullptr) {
    truth.same_over = sweep_index(block.word("same_over"));
    if (truth.same_over < 0)
      unknown(block.find("same_over")->position, "Sweep", block.word("same_over"), sweep_names());
  }
  truth.predicted = block.find("equals") != nullptr && block.word("equals") == "predicted";
  if (!truth.predicted && !truth.value && !truth.above && !truth.below && truth.same_over < 0)
    diagnostics_.error(
        block.position,
        "a Truth needs `equals = predicted`, `value`, `above`, `below` or `same_over`");
  if (truth.predicted && truth.value)
    diagnostics_.error(block.find("value")->position,
                       "a Truth equals the prediction or a value, not both");
  truth.subjects = named_subjects(block);
  truth.only = conditions(block);
  truth.name = block.name;
  truth.words = truth_words(block, truth);
  plan_.truths.push_back(std::move(truth));
}

/// The subjects that the block's `subjects` names; empty without.
std::vector<int> PlanBuilder::named_subjects(const Object& block) {
  std::vector<int> subjects;
  if (block.find("subjects") == nullptr) return subjects;
  std::vector<std::string> names;
  for (const SubjectPlan& subject : plan_.subjects) names.push_back(subject.info.name);
  for (const std::string& word : block.find("subjects")->words) {
    const auto subject = std::find(names.begin(), names.end(), word);
    if (subject == names.end()) unknown(block.find("subjects")->position, "Subject", word, names);
    subjects.push_back(static_cast<int>(subject - names.begin()));
  }
  return subjects;
}

void PlanBuilder::check_only_option(const Object& study) {
  std::vector<std::string> names;
  for (const SubjectPlan& subject : plan_.subjects) names.push_back(subject.info.name);
  for (const std::string& only : options_.only)
    if (std::find(names.begin(), names.end(), only) == names.end())
      unknown(study.position, "Subject", only, names);
}

SubjectPlan subject_of(const Object& block) {
  const auto word = [&](const char* field) {
    return block.find(field) == nullptr ? std::string() : block.word(field);
  };
  SubjectPlan subject;
  subject.info.name = block.name;
  subject.engine = word("engine");
  subject.contact = word("contact");
  subject.integrator = word("integrator");
  subject.settings = word("settings");
  return subject;
}

std::vector<Assignment> plan_parts(StudyPlan& plan, const Object& study,
                                   const std::vector<language::ParameterDeclaration>& parameters,
                                   const PlanOptions& options, Diagnostics& diagnostics) {
  std::vector<std::string> names;
  for (const language::ParameterDeclaration& parameter : parameters)
    names.push_back(parameter.name);
  PlanBuilder parts(plan, std::move(names), options, diagnostics);
  for (const Object* block : study.children_of("Sweep")) parts.add_sweep(*block);
  for (const Object* block : study.children_of("Measure")) parts.add_metric(*block);
  for (const Object* block : study.children_of("Subject")) parts.add_subject(*block);
  for (const Object* block : study.children_of("Truth")) parts.add_truth(*block);
  for (const Object* block : study.children_of("Plot")) parts.add_plot(*block);
  for (const Object* block : study.children_of("Table")) parts.add_table(*block);
  parts.check_only_option(study);
  parts.check_size(study);
  return parts.fixes(study);
}

}  // namespace hookpoint::studies
