// What a Matrix's page and table have in common: one row a study, regime, subject and metric.
#pragma once

#include <optional>
#include <string>
#include <vector>

#include "studies/report/matrix.h"
#include "studies/results/summary.h"

namespace hookpoint::studies {

struct MatrixRow {
  std::size_t study = 0, subject = 0;
  std::optional<std::size_t> metric;  ///< none: the subject has no measurement in the study
  Regime regime = Regime::none;
  MetricSummary summary;
  SubjectSummary counts;  ///< of the regime's rows
  std::string status;     ///< why nothing was measured, or the first run that stopped; "" if none
};

std::vector<MatrixRow> matrix_rows(const MatrixResult& matrix);

/// All of a subject in a study: the cell of the overview.
struct MatrixCell {
  bool there = false;  ///< the study has such a subject, with runs
  SubjectSummary counts;
  int passed = 0, failed = 0;
  std::string status;  ///< as of a row
};

/// Names of subjects, each once, in the order in which the studies bring them.
std::vector<std::string> matrix_subjects(const MatrixResult& matrix);
MatrixCell matrix_cell(const MatrixStudy& study, const std::string& subject);

}  // namespace hookpoint::studies
