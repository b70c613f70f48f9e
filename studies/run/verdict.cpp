#include "studies/run/verdict.h"

#include <algorithm>
#include <cmath>
#include <string>
#include <utility>

#include "studies/predictions/predictions.h"
#include "studies/results/idleness.h"
#include "studies/results/seed_means.h"
#include "studies/results/summary.h"
#include "studies/run/execute.h"
#include "studies/run/group_metrics.h"

namespace hookpoint::studies {
namespace {

bool has(const RunResult& run, RunOutcome outcome) { return outcome_of(run) == outcome; }

bool near(double measured, double expected, const TruthPlan& truth) {
  return std::abs(measured - expected) <=
         std::max(truth.within, truth.tolerance * std::abs(expected));
}

/// What a definition of the user's own says of the row; null of another metric.
const RowForm* form_of(const StudyPlan& plan, std::size_t metric, std::size_t row) {
  const UserMetric* user = plan.metrics[metric].definition->user;
  return user == nullptr ? nullptr : &plan.rows[row].forms[user->index];
}

bool applies(const StudyPlan& plan, const TruthPlan& truth, const RowPlan& row) {
  const bool named =
      truth.subjects.empty() ||
      std::find(truth.subjects.begin(), truth.subjects.end(), row.subject) != truth.subjects.end();
  return named && plan.covers(truth.only, row);
}

/// What a Truth says of a row.
struct Judgement {
  /// `reference`: others are to equal the row, which says nothing by itself.
  enum class Kind { uncovered, skipped, unjudged, reference, fails, holds };
  Kind kind = Kind::uncovered;
  std::string why = {};  ///< of a row that is skipped, or not judged

  static Judgement of(bool holds) { return {holds ? Kind::holds : Kind::fails}; }
  bool judged() const { return kind == Kind::fails || kind == Kind::holds; }
  bool unjudged() const { return kind == Kind::unjudged || kind == Kind::reference; }
};

Judgement not_judged(std::string why) { return {Judgement::Kind::unjudged, std::move(why)}; }

/// Why subjects of the study have no runs here; "" where all have.
std::string why_others_are_left_out(const StudyPlan& plan) {
  if (!plan.only.empty()) return "--only leaves out other subjects";
  for (const SubjectPlan& subject : plan.subjects)
    if (!subject.info.available) return "engine " + subject.info.engine + " is not on this machine";
  return "";
}

/// What the Truth says of the row by itself.
Judgement judge(const StudyPlan& plan, const RunResult& run, std::size_t row,
                const TruthPlan& truth) {
  if (!applies(plan, truth, plan.rows[row])) return {};
  if (has(run, RunOutcome::skipped)) return {Judgement::Kind::skipped, run.status};
  // Whoever names a subject claims that it runs and has the metric.
  const bool named = !truth.subjects.empty();
  if (has(run, RunOutcome::refused)) return named ? Judgement::of(false) : not_judged(run.status);
  const RowForm* form = form_of(plan, truth.metric, row);
  if (form != nullptr && !form->missing.empty())
    return named ? Judgement::of(false) : not_judged(form->missing);
  const MetricValue& metric = run.metrics[truth.metric];
  if (truth.predicted && !metric.predicted)
    return not_judged("no closed form" + (metric.no_form.empty() ? "" : ": " + metric.no_form));
  if (!metric.measured && plan.metrics[truth.metric].definition->scope == MetricScope::subjects)
    if (std::string why = why_others_are_left_out(plan); !why.empty())
      return {Judgement::Kind::skipped, std::move(why)};
  if (!metric.measured) return Judgement::of(false);
  const double measured = *metric.measured;
  if (truth.of_scene) return Judgement::of(std::abs(measured - *metric.predicted) <= form->allowed);
  bool ok = true;
  if (truth.predicted) ok = ok && near(measured, *metric.predicted, truth);
  if (truth.value) ok = ok && near(measured, *truth.value, truth);
  if (truth.above) ok = ok && measured > *truth.above;
  if (truth.below) ok = ok && measured < *truth.below;
  return Judgement::of(ok);
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

/// Whether the Truth claims something of a row beside that it is as another one.
bool claims_by_itself(const TruthPlan& truth) {
  return truth.predicted || truth.value || truth.above || truth.below;
}

/// What the Truth says of the row `row` of `result`; of one that holds along a sweep `equals` is
/// the row that it is to equal.
Judgement judge(const StudyPlan& plan, const StudyResult& result, std::size_t row,
                const TruthPlan& truth, std::optional<std::ptrdiff_t> equals) {
  Judgement alone = judge(plan, result.rows[row], row, truth);
  const auto& measured = result.rows[row].metrics[truth.metric].measured;
  if (!equals || !alone.judged() || !measured) return alone;
  const std::string& sweep = plan.sweeps[static_cast<std::size_t>(truth.same_over)].column.name;
  if (*equals < 0) return not_judged("no run has the first value of " + sweep);
  const auto first = static_cast<std::size_t>(*equals);
  const RunResult& other = result.rows[first];
  if (has(other, RunOutcome::skipped)) return {Judgement::Kind::skipped, other.status};
  if (has(other, RunOutcome::refused)) return not_judged(other.status);
  if (first == row && !claims_by_itself(truth))
    return {Judgement::Kind::reference,
            "the run with the first value of " + sweep + " has no other to be compared with"};
  const auto& reference = other.metrics[truth.metric].measured;
  return Judgement::of(alone.kind == Judgement::Kind::holds && reference &&
                       near(*measured, *reference, truth));
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

std::optional<double> in_unit(const std::optional<double>& value, double scale) {
  return value ? std::optional(*value / scale) : std::nullopt;
}

/// The values of a metric of a row.
MetricValue value_of(const StudyPlan& plan, std::size_t metric, std::size_t row,
                     RunRecord& record) {
  KeptValue& kept = record.values[kept_name(*plan.metrics[metric].definition)];
  const double scale = plan.metrics[metric].unit.scale;
  MetricValue value{in_unit(kept.measured, scale), in_unit(kept.predicted, scale), std::nullopt};
  value.no_form = std::move(kept.no_form);
  if (const RowForm* form = form_of(plan, metric, row)) {
    value.predicted = form->predicted;
    value.no_form = form->no_form;
  }
  return value;
}

RunResult run_result(const StudyPlan& plan, const StudyRows& kept, std::size_t row,
                     RunRecord record) {
  RunResult run = empty_row(plan, plan.rows[row]);
  run.status = record.status;
  run.regime = record.regime;
  run.metrics.reserve(plan.metrics.size());
  for (std::size_t i = 0; i < plan.metrics.size(); ++i)
    run.metrics.push_back(value_of(plan, i, row, record));
  run.traces.reserve(plan.plots.size());
  for (std::size_t plot = 0; plot < plan.plots.size(); ++plot)
    run.traces.push_back(kept.trace(row, plot));
  return run;
}

/// Rows that differ in the seed alone, in the order of their first ones; without seeds each row.
std::vector<std::vector<std::size_t>> seed_groups(const StudyPlan& plan) {
  auto groups = plan.groups_along(plan.seed_sweep());
  std::ranges::sort(groups, {}, [](const auto& group) { return group.front(); });
  return groups;
}

/// Of the first row that a run is to equal: it holds as far as others could be compared with it.
void judge_references(const std::vector<std::ptrdiff_t>& first,
                      std::vector<Judgement>& judgements) {
  for (std::size_t row = 0; row < judgements.size(); ++row) {
    const std::ptrdiff_t reference = first[row];
    if (reference < 0 || !judgements[row].judged()) continue;
    Judgement& of_reference = judgements[static_cast<std::size_t>(reference)];
    if (of_reference.kind == Judgement::Kind::reference) of_reference = Judgement::of(true);
  }
}

/// Why the Truth has judged no run.
Idleness idleness_of(const StudyPlan& plan, const TruthPlan& planned, const StudyResult& result,
                     const TruthResult& truth, const std::string& skipped) {
  if (truth.passed + truth.failed > 0) return {};
  const SweepValues where = plan.admitted(planned.only);
  const RunSelection selection{planned.subjects, {&where}};
  // The scene says which laws and integrators its Expect covers.
  if (truth.unjudged > 0)
    return allowed_by(planned.may_be_empty || planned.of_scene,
                      unless_left_out(result, selection, {Idle::fault, truth.unjudged_why}));
  if (!skipped.empty()) return {Idle::left_out, skipped};
  return allowed_by(planned.may_be_empty, why_no_run(result, selection));
}

/// Judges the Truth over the rows, or over the means of rows that differ in the seed alone, each
/// verdict that of all runs of the mean.
void judge_all(const StudyPlan& plan, std::size_t index, StudyResult& result) {
  const TruthPlan& planned = plan.truths[index];
  TruthResult& truth = result.truths[index];
  const auto groups = seed_groups(plan);
  StudyResult means;
  if (plan.seed_sweep() >= 0) {
    // A row has its mean where the mean is judged.
    means = result;
    for (const std::vector<std::size_t>& group : groups) {
      const RunResult mean = mean_of_rows(result, group);
      for (const std::size_t row : group) means.rows[row] = mean;
    }
  }
  const StudyResult& judged = plan.seed_sweep() >= 0 ? means : result;
  const bool along = planned.same_over >= 0;
  const auto first =
      along ? first_of_groups(plan, planned.same_over) : std::vector<std::ptrdiff_t>();
  std::vector<Judgement> judgements(plan.rows.size());
  for (const std::vector<std::size_t>& group : groups) {
    const std::size_t row = group.front();
    judgements[row] =
        judge(plan, judged, row, planned, along ? std::optional(first[row]) : std::nullopt);
  }
  if (along) judge_references(first, judgements);
  std::string skipped;
  for (const std::vector<std::size_t>& group : groups) {
    const std::size_t row = group.front();
    const Judgement& judgement = judgements[row];
    if (judgement.kind == Judgement::Kind::skipped && skipped.empty()) skipped = judgement.why;
    if (judgement.unjudged() && truth.unjudged++ == 0) truth.unjudged_why = judgement.why;
    if (!judgement.judged()) continue;
    const bool holds = judgement.kind == Judgement::Kind::holds;
    for (const std::size_t each : group)
      add_verdict(result.rows[each].metrics[planned.metric], holds);
    ++(holds ? truth.passed : truth.failed);
    if (!holds && truth.first_failure < 0) truth.first_failure = static_cast<int>(row);
  }
  truth.idleness = idleness_of(plan, planned, result, truth, skipped);
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
  for (std::size_t i = 0; i < plan.metrics.size(); ++i) {
    const MetricDefinition& metric = *plan.metrics[i].definition;
    result.metrics.push_back(
        {std::string(metric.name), plan.metrics[i].unit.text, metric.timing(), metric.regime,
         metric.scope == MetricScope::subjects ? why_others_are_left_out(plan) : "",
         metric.user != nullptr ? metric.user->predicted != nullptr : metric.predict != nullptr});
  }
  for (const PlotPlan& plot : plan.plots) result.plots.push_back(plot.spec);
  result.tables = plan.tables;
  result.claims = plan.claims;
  for (const TruthPlan& truth : plan.truths)
    result.truths.push_back({truth.name, truth.words, static_cast<int>(truth.metric)});
  result.rows.reserve(plan.rows.size());
  for (const RowPlan& row : plan.rows) {
    result.rows.push_back(empty_row(plan, row));
    RunResult& run = result.rows.back();
    run.metrics.resize(plan.metrics.size());
    if (!row.matched.empty()) result.matched.push_back({run.parameters, run.subject, row.matched});
  }
  result.warnings = plan.warnings;
  result.quick = plan.quick;
  for (std::size_t i = 0; i < plan.subjects.size() && !plan.only.empty(); ++i)
    if (std::ranges::find(plan.only, plan.subjects[i].info.name) == plan.only.end())
      result.unselected.push_back(static_cast<int>(i));
  if (plan.seed_sweep() >= 0) result.seed_sweep = static_cast<std::size_t>(plan.seed_sweep());
  return result;
}

RunResult assemble_row(const StudyPlan& plan, const StudyRows& kept, std::size_t row) {
  RunResult run = run_result(plan, kept, row, kept.numbers(row));
  for (const TruthPlan& truth : plan.truths) {
    MetricValue& value = run.metrics[truth.metric];
    const bool alone = truth.same_over < 0 && plan.seed_sweep() < 0 &&
                       plan.metrics[truth.metric].definition->scope == MetricScope::run;
    if (!alone) continue;
    if (const Judgement judgement = judge(plan, run, row, truth); judgement.judged())
      add_verdict(value, judgement.kind == Judgement::Kind::holds);
  }
  return run;
}

StudyResult assemble(const StudyPlan& plan, const StudyRows& kept, Notices& notices) {
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
  return std::all_of(result.rows.begin(), result.rows.end(),
                     [](const RunResult& run) {
                       const bool judged =
                           std::none_of(run.metrics.begin(), run.metrics.end(),
                                        [](const MetricValue& value) { return value.ok == false; });
                       return judged && outcome_of(run) != RunOutcome::stopped;
                     }) &&
         !has_fault(idle_blocks(result));
}

}  // namespace hookpoint::studies
