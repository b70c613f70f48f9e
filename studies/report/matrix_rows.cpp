#include "studies/report/matrix_rows.h"

#include <algorithm>

#include "text/number.h"

namespace hookpoint::studies {
namespace {

/// Of the first row that did not finish, "" when all did.
std::string first_status(const StudyResult& study, int subject, std::optional<Regime> regime) {
  for (const RunResult& row : study.rows)
    if (row.subject == subject && (!regime || row.regime == *regime) && row.status != "ok")
      return row.status;
  return "";
}

void add_rows(const MatrixResult& matrix, std::size_t study, const RegimeTable& table,
              std::vector<MatrixRow>& rows) {
  const StudyResult& result = *matrix.studies[study].result;
  for (const std::size_t subject : table.subjects) {
    MatrixRow row{study, subject, std::nullopt, table.regime, {}, table.summary.subjects[subject],
                  {}};
    row.status = first_status(result, static_cast<int>(subject), table.regime);
    bool measured = false;
    for (const std::size_t metric : table.metrics) {
      row.summary = row.counts.metrics[metric];
      if (row.summary.values == 0 && row.summary.failed == 0) continue;
      row.metric = metric;
      rows.push_back(row);
      measured = true;
    }
    row.metric.reset();
    row.summary = {};
    if (!measured) rows.push_back(std::move(row));
  }
}

std::string number(bool there, double value) { return there ? text::shortest(value) : ""; }

}  // namespace

std::vector<MatrixRow> matrix_rows(const MatrixResult& matrix) {
  std::vector<MatrixRow> rows;
  for (std::size_t i = 0; i < matrix.studies.size(); ++i)
    for (const RegimeTable& table : regime_tables(*matrix.studies[i].result))
      add_rows(matrix, i, table, rows);
  return rows;
}

std::vector<std::string> matrix_subjects(const MatrixResult& matrix) {
  std::vector<std::string> names;
  for (const MatrixStudy& study : matrix.studies)
    for (const SubjectInfo& subject : study.result->subjects)
      if (std::ranges::find(names, subject.name) == names.end()) names.push_back(subject.name);
  return names;
}

MatrixCell matrix_cell(const MatrixStudy& study, const std::string& subject) {
  MatrixCell cell;
  const auto& subjects = study.result->subjects;
  const auto found = std::ranges::find(subjects, subject, &SubjectInfo::name);
  if (found == subjects.end()) return cell;
  const auto index = found - subjects.begin();
  cell.counts = summarise(*study.result).subjects[static_cast<std::size_t>(index)];
  cell.there = cell.counts.rows() > 0;
  for (const MetricSummary& metric : cell.counts.metrics) {
    cell.passed += metric.passed;
    cell.failed += metric.failed;
  }
  cell.status = first_status(*study.result, static_cast<int>(index), std::nullopt);
  return cell;
}

output::CsvTable matrix_table(const MatrixResult& matrix) {
  output::CsvTable table;
  table.header = {"study",      "regime",      "metric", "unit",     "subject", "engine", "law",
                  "integrator", "settings",    "runs",   "finished", "median",  "least",  "largest",
                  "worst",      "closed_form", "passed", "failed",   "status"};
  for (const MatrixRow& row : matrix_rows(matrix)) {
    const StudyResult& study = *matrix.studies[row.study].result;
    if (row.metric && study.metrics[*row.metric].timing) continue;
    const SubjectInfo& subject = study.subjects[row.subject];
    const MetricSummary& summary = row.summary;
    const bool any = summary.values > 0;
    const MetricValue worst =
        row.metric && summary.worst >= 0
            ? study.rows[static_cast<std::size_t>(summary.worst)].metrics[*row.metric]
            : MetricValue{};
    table.rows.push_back(
        {study.name, std::string(word(row.regime)),
         row.metric ? study.metrics[*row.metric].name : "",
         row.metric ? study.metrics[*row.metric].unit : "", subject.name, subject.engine,
         subject.law, subject.integrator, subject.settings, std::to_string(row.counts.rows()),
         std::to_string(row.counts.finished), number(any, summary.median),
         number(any, summary.least), number(any, summary.largest),
         number(worst.measured.has_value(), worst.measured.value_or(0.)),
         number(worst.predicted.has_value(), worst.predicted.value_or(0.)),
         std::to_string(summary.passed), std::to_string(summary.failed), row.status});
  }
  return table;
}

}  // namespace hookpoint::studies
