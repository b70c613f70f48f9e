#include "studies/run/verdict.h"

#include <algorithm>
#include <cmath>
#include <string>
#include <utility>

#include "studies/run/execute.h"
#include "studies/run/group_metrics.h"
#include "studies/seed_means.h"
#include "studies/summary.h"

namespace hookpoint::studies {
namespace {

bool has(const RunResult& run, RunOutcome outcome) { return outcome_of(run) == outcome; }

bool near(double measured, double expected, const TruthPlan& truth) {
  return std::abs(measured - expected) <=
         std::max(truth.within, truth.tolerance * std::abs(expected));
}

/// What a definition of the user's own says of the row; null of another metric.
const RowForm* form_of(const StudyPlan& plan, std::size_t metric, std::size_t row) {
  const UserMetric* user = plan.metrics[metric]->user;
  return user == nullptr ? nullptr : &plan.rows[row].forms[user->index];
}

bool applies(const StudyPlan& plan, const TruthPlan& truth, const RowPlan& row) {
  const bool named =
      truth.subjects.empty() ||
      std::find(truth.subjects.begin(), truth.subjects.end(), row.subject) != truth.subjects.end();
  return named && plan.covers(truth.only, row);
}

/// What the Truth says of the row by itself; nothing where it says nothing about it.
std::optional<bool> judge(const StudyPlan& plan, const RunResult& run, std::size_t row,
                          const TruthPlan& truth) {
  if (has(run, RunOutcome::skipped) || !applies(plan, truth, plan.rows[row])) return std::nullopt;
  if (has(run, RunOutcome::refused) && truth.subjects.empty()) return std::nullopt;
  const RowForm* form = form_of(plan, truth.metric, row);
  if (form != nullptr && !form->missing.empty() && truth.subjects.empty()) return std::nullopt;
  const MetricValue& metric = run.metrics[truth.metric];
  if (truth.predicted && !metric.predicted) return std::nullopt;
  if (!metric.measured) return false;
  const double measured = *metric.measured;
  if (truth.of_scene) return std::abs(measured - *metric.predicted) <= form->allowed;
  bool ok = true;
  if (truth.predicted) ok = ok && near(measured, *metric.predicted, truth);
  if (truth.value) ok = ok && near(measured, *truth.value, truth);
  if (truth.above) ok = ok && measured > *truth.above;
  if (truth.below) ok = ok && measured < *truth.below;
  return ok;
}

/// For each row that of its group which has the first value of sweep `sweep`; -1 when the plan has
/// none.
std::vector<std::ptrdiff_t> first_of_groups(const StudyPlan& plan, int sweep) {
  std::vector<std::ptrdiff_t> first(plan.rows.size(), -1);
  for (const std::vector<std::size_t>& group : plan.groups_along(sweep)) {
    if (plan.rows[group.front()].values[static_cast<std::size_t>(sweep)] != 0) continue;
    for (const std::size_t row : group) first[row] = static_cast<std::ptrdiff_t>(group.front());
  }
  return first;
}

/// What a Truth that holds along a sweep says of the row, beside the row that it is to equal.
std::optional<bool> judge(const StudyPlan& plan, const StudyResult& result, std::size_t row,
                          const TruthPlan& truth, std::ptrdiff_t equals) {
  const auto alone = judge(plan, result.rows[row], row, truth);
  const auto& measured = result.rows[row].metrics[truth.metric].measured;
  if (!alone || !measured) return alone;
  if (equals < 0) return std::nullopt;
  const RunResult& other = result.rows[static_cast<std::size_t>(equals)];
  const auto& reference = other.metrics[truth.metric].measured;
  return *alone && reference && near(*measured, *reference, truth);
}

void add_verdict(MetricValue& value, bool verdict) {
  value.ok = value.ok.value_or(true) && verdict;
}

/// A row that has not run.
RunResult empty_row(const StudyPlan& plan, const RowPlan& row) {
  RunResult run;
  for (std::size_t i = 0; i < plan.sweeps.size(); ++i)
    run.parameters.push_back(plan.sweeps[i].column.values[static_cast<std::size_t>(row.values[i])]);
  run.subject = row.subject;
  run.composition = row.composition;
  return run;
}

RunResult run_result(const StudyPlan& plan, const KeptRows& kept, std::size_t row,
                     RunRecord record) {
  RunResult run = empty_row(plan, plan.rows[row]);
  run.status = std::move(record.status);
  run.regime = record.regime;
  for (std::size_t i = 0; i < plan.metrics.size(); ++i) {
    const KeptValue& value = record.values[kept_name(*plan.metrics[i])];
    const RowForm* form = form_of(plan, i, row);
    run.metrics.push_back(
        {value.measured, form == nullptr ? value.predicted : form->predicted, std::nullopt});
  }
  run.traces.reserve(plan.plots.size());
  for (std::size_t plot = 0; plot < plan.plots.size(); ++plot)
    run.traces.push_back(kept.trace(row, plot));
  return run;
}

/// Rows that differ in the seed alone, in the order of their first ones.
std::vector<std::vector<std::size_t>> seed_groups(const StudyPlan& plan) {
  auto groups = plan.groups_along(plan.seed_sweep());
  std::ranges::sort(groups, {}, [](const auto& group) { return group.front(); });
  return groups;
}

/// What a Truth says of the means over seeds, each verdict that of all runs of the mean.
void judge_means(const StudyPlan& plan, std::size_t index, StudyResult& result) {
  const TruthPlan& planned = plan.truths[index];
  TruthResult& truth = result.truths[index];
  const auto groups = seed_groups(plan);
  // A row has its mean where the mean is judged.
  StudyResult means = result;
  for (const std::vector<std::size_t>& group : groups) {
    const RunResult mean = mean_of_rows(result, group);
    for (const std::size_t row : group) means.rows[row] = mean;
  }
  const bool along = planned.same_over >= 0;
  const auto first =
      along ? first_of_groups(plan, planned.same_over) : std::vector<std::ptrdiff_t>();
  for (const std::vector<std::size_t>& group : groups) {
    const std::size_t row = group.front();
    const std::optional<bool> verdict = along ? judge(plan, means, row, planned, first[row])
                                              : judge(plan, means.rows[row], row, planned);
    if (!verdict) continue;
    for (const std::size_t each : group)
      add_verdict(result.rows[each].metrics[planned.metric], *verdict);
    ++(*verdict ? truth.passed : truth.failed);
    if (!*verdict && truth.first_failure < 0) truth.first_failure = static_cast<int>(row);
  }
}

void judge_all(const StudyPlan& plan, std::size_t index, StudyResult& result) {
  if (plan.seed_sweep() >= 0) return judge_means(plan, index, result);
  const TruthPlan& planned = plan.truths[index];
  TruthResult& truth = result.truths[index];
  const bool along = planned.same_over >= 0;
  const auto first =
      along ? first_of_groups(plan, planned.same_over) : std::vector<std::ptrdiff_t>();
  for (std::size_t row = 0; row < plan.rows.size(); ++row) {
    const std::optional<bool> verdict = along ? judge(plan, result, row, planned, first[row])
                                              : judge(plan, result.rows[row], row, planned);
    if (!verdict) continue;
    add_verdict(result.rows[row].metrics[planned.metric], *verdict);
    ++(*verdict ? truth.passed : truth.failed);
    if (!*verdict && truth.first_failure < 0) truth.first_failure = static_cast<int>(row);
  }
}

}  // namespace

StudyResult empty_table(const StudyPlan& plan) {
  StudyResult result;
  result.name = plan.name;
  result.title = plan.title;
  result.question = plan.question;
  result.file = plan.file;
  for (const SweepPlan& sweep : plan.sweeps) result.sweeps.push_back(sweep.column);
  for (const SubjectPlan& subject : plan.subjects) result.subjects.push_back(subject.info);
  result.compositions = plan.compositions;
  for (const MetricDefinition* metric : plan.metrics)
    result.metrics.push_back(
        {std::string(metric->name), std::string(metric->unit), metric->timing(), metric->regime});
  for (const PlotPlan& plot : plan.plots) result.plots.push_back(plot.spec);
  result.tables = plan.tables;
  result.claims = plan.claims;
  for (const TruthPlan& truth : plan.truths)
    result.truths.push_back({truth.name, truth.words, static_cast<int>(truth.metric)});
  for (const RowPlan& row : plan.rows) {
    result.rows.push_back(empty_row(plan, row));
    RunResult& run = result.rows.back();
    run.metrics.resize(plan.metrics.size());
    if (!row.matched.empty()) result.matched.push_back({run.parameters, run.subject, row.matched});
  }
  result.warnings = plan.warnings;
  if (plan.seed_sweep() >= 0) result.seed_sweep = static_cast<std::size_t>(plan.seed_sweep());
  return result;
}

RunResult assemble_row(const StudyPlan& plan, const KeptRows& kept, std::size_t row) {
  RunResult run = run_result(plan, kept, row, kept.numbers(row));
  for (const TruthPlan& truth : plan.truths) {
    MetricValue& value = run.metrics[truth.metric];
    const bool alone = truth.same_over < 0 && plan.seed_sweep() < 0 &&
                       plan.metrics[truth.metric]->scope == MetricScope::run;
    if (!alone) continue;
    if (const auto verdict = judge(plan, run, row, truth)) add_verdict(value, *verdict);
  }
  return run;
}

StudyResult assemble(const StudyPlan& plan, const KeptRows& kept, Notices& notices) {
  StudyResult result = empty_table(plan);
  for (std::size_t row = 0; row < plan.rows.size(); ++row) {
    RunRecord record = kept.numbers(row);
    notices.add(row, record.notices);
    for (const auto& metric : plan.user_metrics)
      if (const RowForm& form = plan.rows[row].forms[metric->index]; !form.missing.empty())
        notices.add(row, {metric->name + ": " + form.missing});
    result.rows[row] = run_result(plan, kept, row, std::move(record));
  }
  measure_groups(plan, kept, result);
  for (std::size_t i = 0; i < plan.truths.size(); ++i) judge_all(plan, i, result);
  return result;
}

bool all_truths_hold(const StudyResult& result) {
  return std::all_of(result.rows.begin(), result.rows.end(), [](const RunResult& run) {
    const bool judged = std::none_of(run.metrics.begin(), run.metrics.end(),
                                     [](const MetricValue& value) { return value.ok == false; });
    return judged && outcome_of(run) != RunOutcome::stopped;
  });
}

}  // namespace hookpoint::studies
