// The tables of results as LaTeX.
#pragma once

#include <string>
#include <vector>

#include "output/files/csv.h"
#include "output/latex/latex.h"
#include "studies/results/result.h"

namespace hookpoint::studies {

/// The first `columns` columns of a table of which a CSV is written too; of a number three digits.
output::LatexTable latex_table_of(const std::string& name, const std::string& caption,
                                  const output::CsvTable& table, std::size_t columns,
                                  std::size_t text_columns);

/// A study's Tables, each as the file of its name, and its subjects by its metrics as "summary".
std::vector<output::LatexTable> latex_tables(const StudyResult& study);

}  // namespace hookpoint::studies
