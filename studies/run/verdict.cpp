#include "studies/run/verdict.h"

#include <algorithm>
#include <cmath>

#include "studies/predictions/predictions.h"
#include "studies/run/group_metrics.h"
#include "studies/summary.h"

namespace hookpoint::studies {
namespace {

bool has(const RunResult& run, RunOutcome outcome) { return outcome_of(run) == outcome; }

bool near(double measured, double expected, const TruthPlan& truth) {
  return std::abs(measured - expected) <=
         std::max(truth.within, truth.tolerance * std::abs(expected));
}

/// The row that differs from `row` only in that it has the first value of sweep `sweep`; null when
/// the plan has none.
const RunResult* first_of_sweep(const StudyPlan& plan, const StudyResult& result, std::size_t row,
                                int sweep) {
  const std::size_t first = plan.rows_along(row, sweep).front();
  const bool there = plan.rows[first].values[static_cast<std::size_t>(sweep)] == 0;
  return there ? &result.rows[first] : nullptr;
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
  const MetricValue& metric = run.metrics[truth.metric];
  if (truth.predicted && !metric.predicted) return std::nullopt;
  if (!metric.measured) return false;
  const double measured = *metric.measured;
  bool ok = true;
  if (truth.predicted) ok = ok && near(measured, *metric.predicted, truth);
  if (truth.value) ok = ok && near(measured, *truth.value, truth);
  if (truth.above) ok = ok && measured > *truth.above;
  if (truth.below) ok = ok && measured < *truth.below;
  return ok;
}

/// The same, beside the row that it is to equal.
std::optional<bool> judge(const StudyPlan& plan, const StudyResult& result, std::size_t row,
                          const TruthPlan& truth) {
  const auto alone = judge(plan, result.rows[row], row, truth);
  const auto& measured = result.rows[row].metrics[truth.metric].measured;
  if (!alone || !measured || truth.same_over < 0) return alone;
  const RunResult* other = first_of_sweep(plan, result, row, truth.same_over);
  if (other == nullptr) return std::nullopt;
  const auto& reference = other->metrics[truth.metric].measured;
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
  return run;
}

RunResult run_result(const StudyPlan& plan, const EngineTable& engines, const RowPlan& row,
                     const RowOutcome& outcome) {
  RunResult run = empty_row(plan, row);
  run.status = outcome.status;
  run.traces = outcome.traces;
  for (const auto& measured : outcome.measured)
    run.metrics.push_back({measured, std::nullopt, std::nullopt});
  const auto engine = engines.find(row.experiment.engine);
  try {
    const simulation::Experiment experiment = row.whole();
    const RunContext context = make_context(experiment, plan.settle, plan.duration);
    run.regime = regime_of(context);
    const bool ran = !has(run, RunOutcome::skipped) && !has(run, RunOutcome::refused);
    if (!ran || engine == engines.end()) return run;
    const PeerContact peer = peer_contact(engine->second, experiment);
    for (std::size_t i = 0; i < plan.metrics.size(); ++i)
      run.metrics[i].predicted = predict(plan.metrics[i]->name, context, peer);
  } catch (const simulation::ExperimentError&) {
    return run;  // the row's status says already why it could not run
  }
  return run;
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
  for (const MetricDefinition* metric : plan.metrics)
    result.metrics.push_back(
        {std::string(metric->name), std::string(metric->unit), metric->timing(), metric->regime});
  for (const PlotPlan& plot : plan.plots) result.plots.push_back(plot.spec);
  for (const TruthPlan& truth : plan.truths)
    result.truths.push_back({truth.name, truth.words, static_cast<int>(truth.metric)});
  for (const RowPlan& row : plan.rows) {
    result.rows.push_back(empty_row(plan, row));
    result.rows.back().metrics.resize(plan.metrics.size());
  }
  result.warnings = plan.warnings;
  return result;
}

RunResult assemble_row(const StudyPlan& plan, const EngineTable& engines, std::size_t row,
                       const RowOutcome& outcome) {
  RunResult run = run_result(plan, engines, plan.rows[row], outcome);
  for (const TruthPlan& truth : plan.truths) {
    MetricValue& value = run.metrics[truth.metric];
    const bool alone = truth.same_over < 0 && plan.metrics[truth.metric]->scope == MetricScope::run;
    if (!alone) continue;
    if (const auto verdict = judge(plan, run, row, truth)) add_verdict(value, *verdict);
  }
  return run;
}

StudyResult assemble(const StudyPlan& plan, const EngineTable& engines,
                     const std::vector<RowOutcome>& outcomes) {
  StudyResult result = empty_table(plan);
  for (std::size_t i = 0; i < plan.rows.size(); ++i)
    result.rows[i] = run_result(plan, engines, plan.rows[i], outcomes[i]);
  measure_groups(plan, outcomes, result);
  for (std::size_t i = 0; i < plan.rows.size(); ++i) {
    for (std::size_t k = 0; k < plan.truths.size(); ++k) {
      const std::optional<bool> verdict = judge(plan, result, i, plan.truths[k]);
      if (!verdict) continue;
      add_verdict(result.rows[i].metrics[plan.truths[k].metric], *verdict);
      TruthResult& truth = result.truths[k];
      ++(*verdict ? truth.passed : truth.failed);
      if (!*verdict && truth.first_failure < 0) truth.first_failure = static_cast<int>(i);
    }
  }
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
