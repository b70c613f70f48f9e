// A Matrix: studies of several files shown in one page, every subject in every scene by every
// metric.
#pragma once

#include <string>
#include <vector>

#include "output/files/csv.h"
#include "studies/report/report.h"
#include "studies/results/result.h"

namespace hookpoint::studies {

/// A study of the matrix as it was run.
struct MatrixStudy {
  const StudyResult* result;          ///< outlives the matrix
  std::string text;                   ///< of the .hook file that makes it
  std::vector<ReportFigure> figures;  ///< as its own report has them
};

/// In the order of the file; a study's folder beside the page has its name.
struct MatrixResult {
  std::string name, title, question, file;
  std::vector<MatrixStudy> studies;
};

/// The page: subjects by scenes, then a row a scene, subject and metric with filter and sorting,
/// then each study with its figures and its file. One file without outside resources; links lead to
/// the studies' folders beside it. Pure: the same arguments give the same bytes.
std::string matrix_html(const MatrixResult& matrix, const ReportContext& context);

/// The same rows as a table: study, regime, metric, unit, subject, engine, law, integrator,
/// settings, runs, finished, median, least, largest, worst, closed form, passed, failed, status.
/// Timing metrics are left out, so that the same studies give the same bytes.
output::CsvTable matrix_table(const MatrixResult& matrix);

/// Subjects by scenes for the terminal.
std::string matrix_terminal_table(const MatrixResult& matrix, bool color);

}  // namespace hookpoint::studies
