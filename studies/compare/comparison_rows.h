// Rows of two results.csv brought together: those with the same sweep values and subject.
#pragma once

#include <string>
#include <utility>
#include <vector>

#include "output/files/csv.h"

namespace hookpoint::studies {

struct RowJoin {
  std::vector<std::string> columns;  ///< what joins them: "slope [deg]", "subject"
  std::vector<std::string> first_labels, second_labels;    ///< a row: "slope = 15 deg, ode_default"
  std::vector<std::pair<std::size_t, std::size_t>> pairs;  ///< in the first table's order
  std::vector<std::size_t> only_first, only_second;
};

/// By the columns up to `subject` that both tables have. Throws RunFolderError when a table has no
/// such column, or when one varies more than the other so that a row would have several partners.
RowJoin join_rows(const output::CsvTable& first, const output::CsvTable& second);

}  // namespace hookpoint::studies
