#include "studies/results/summary.h"

#include <algorithm>
#include <cmath>

#include "studies/results/selection.h"
#include "text/number.h"

namespace hookpoint::studies {
namespace {

bool has_measurement(const MetricValue& value) {
  return value.measured && std::isfinite(*value.measured);
}

/// How badly a value does: a failing Truth outweighs any distance.
struct Badness {
  bool fails = false;
  double distance = -1.;
  bool operator<(const Badness& other) const {
    return fails != other.fails ? !fails : distance < other.distance;
  }
};

Badness badness_of(const MetricValue& value) {
  const bool fails = value.ok && !*value.ok;
  return {fails, std::abs(*value.measured - value.predicted.value_or(0.))};
}

bool belongs(const RunResult& row, std::optional<Regime> regime) {
  return !regime || row.regime == *regime;
}

MetricSummary summarise_metric(const StudyResult& study, int subject, std::size_t metric,
                               std::optional<Regime> regime) {
  MetricSummary summary;
  Badness worst;
  std::vector<double> values;
  for (std::size_t i = 0; i < study.rows.size(); ++i) {
    const RunResult& row = study.rows[i];
    if (row.subject != subject || metric >= row.metrics.size() || !belongs(row, regime)) continue;
    const MetricValue& value = row.metrics[metric];
    if (value.ok) ++(*value.ok ? summary.passed : summary.failed);
    if (has_measurement(value)) values.push_back(*value.measured);
    if (!has_measurement(value)) continue;
    if (summary.worst < 0 || worst < badness_of(value)) {
      summary.worst = static_cast<int>(i);
      worst = badness_of(value);
    }
  }
  if (values.empty()) return summary;
  std::sort(values.begin(), values.end());
  summary.values = static_cast<int>(values.size());
  summary.median = values[(values.size() - 1) / 2];
  summary.least = values.front();
  summary.largest = values.back();
  return summary;
}

void count(SubjectSummary& summary, const RunResult& row) {
  switch (outcome_of(row)) {
    case RunOutcome::finished:
      ++summary.finished;
      break;
    case RunOutcome::expected:
      ++summary.expected;
      break;
    case RunOutcome::stopped:
      ++summary.stopped;
      break;
    case RunOutcome::skipped:
      ++summary.skipped;
      break;
    case RunOutcome::refused:
      ++summary.refused;
      break;
  }
}

std::string row_text(const StudyResult& study, const RunResult& row, bool named) {
  std::string text;
  for (std::size_t i = 0; i < study.sweeps.size() && i < row.parameters.size(); ++i) {
    text += text.empty() ? "" : ", ";
    if (named) text += study.sweeps[i].name + " = ";
    text += label_of(study.sweeps[i], row.parameters[i]);
    if (!study.sweeps[i].unit.empty()) text += " " + study.sweeps[i].unit;
  }
  return text;
}

}  // namespace

RunOutcome outcome_of(const RunResult& row) {
  const RunOutcome outcome = outcome_of(row.status);
  if (outcome != RunOutcome::stopped) return outcome;
  const auto judged = [&](bool verdict) {
    return std::any_of(row.metrics.begin(), row.metrics.end(),
                       [&](const MetricValue& value) { return value.ok == verdict; });
  };
  return judged(true) && !judged(false) ? RunOutcome::expected : RunOutcome::stopped;
}

RunOutcome outcome_of(const std::string& status) {
  if (status == "ok") return RunOutcome::finished;
  if (status.starts_with("skipped")) return RunOutcome::skipped;
  return status.starts_with("refused") ? RunOutcome::refused : RunOutcome::stopped;
}

StudySummary summarise(const StudyResult& study, std::optional<Regime> regime) {
  StudySummary summary;
  summary.subjects.resize(study.subjects.size());
  summary.total.metrics.resize(study.metrics.size());
  for (const RunResult& row : study.rows) {
    if (!belongs(row, regime)) continue;
    count(summary.subjects[static_cast<std::size_t>(row.subject)], row);
    count(summary.total, row);
  }
  for (std::size_t subject = 0; subject < study.subjects.size(); ++subject) {
    for (std::size_t metric = 0; metric < study.metrics.size(); ++metric) {
      const MetricSummary one = summarise_metric(study, static_cast<int>(subject), metric, regime);
      summary.subjects[subject].metrics.push_back(one);
      summary.total.metrics[metric].passed += one.passed;
      summary.total.metrics[metric].failed += one.failed;
      summary.passed += one.passed;
      summary.failed += one.failed;
    }
  }
  return summary;
}

std::vector<RegimeTable> regime_tables(const StudyResult& study) {
  std::vector<RegimeTable> tables;
  for (const Regime regime : {Regime::holds, Regime::slides, Regime::none}) {
    if (std::none_of(study.rows.begin(), study.rows.end(),
                     [&](const RunResult& row) { return row.regime == regime; }))
      continue;
    RegimeTable table;
    table.regime = regime;
    table.heading = heading(regime);
    table.summary = summarise(study, regime);
    for (std::size_t i = 0; i < study.subjects.size(); ++i)
      if (table.summary.subjects[i].rows() > 0) table.subjects.push_back(i);
    for (std::size_t i = 0; i < study.metrics.size(); ++i) {
      const Regime home = study.metrics[i].regime;
      const MetricSummary& total = table.summary.total.metrics[i];
      if (home == Regime::none || regime == Regime::none || home == regime ||
          total.passed + total.failed > 0)
        table.metrics.push_back(i);
    }
    tables.push_back(std::move(table));
  }
  // Where all runs are of one regime it tells none of them apart.
  if (tables.size() == 1) tables.front().heading.clear();
  return tables;
}

std::vector<std::size_t> stopped_rows(const StudyResult& study) {
  std::vector<std::size_t> rows;
  for (std::size_t row = 0; row < study.rows.size(); ++row)
    if (outcome_of(study.rows[row]) == RunOutcome::stopped) rows.push_back(row);
  return rows;
}

std::vector<Failure> failures_of(const StudyResult& study) {
  std::vector<Failure> failures;
  for (std::size_t row = 0; row < study.rows.size(); ++row) {
    if (outcome_of(study.rows[row]) == RunOutcome::stopped) continue;
    for (std::size_t metric = 0; metric < study.rows[row].metrics.size(); ++metric)
      if (!study.rows[row].metrics[metric].ok.value_or(true))
        failures.push_back({static_cast<int>(row), static_cast<int>(metric)});
  }
  return failures;
}

std::string parameters_text(const StudyResult& study, const RunResult& row) {
  return row_text(study, row, true);
}

std::string values_text(const StudyResult& study, const RunResult& row) {
  return row_text(study, row, false);
}

std::string spoken(std::string name) {
  std::replace(name.begin(), name.end(), '_', ' ');
  return name;
}

std::string composition(const SubjectInfo& subject) {
  std::string text = subject.engine;
  for (const std::string& part : {subject.law, subject.integrator})
    if (!part.empty()) text += ", " + part;
  if (!subject.settings.empty()) text += ", " + subject.settings + " settings";
  return text;
}

}  // namespace hookpoint::studies
