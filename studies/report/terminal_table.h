// The table that ends a study on the terminal.
#pragma once

#include <string>

#include "studies/results/result.h"

namespace hookpoint::studies {

struct TableStyle {
  bool color = false;       ///< only when standard output is a terminal
  std::size_t width = 120;  ///< columns that may be used
};

/// Subjects by metrics, each metric's worst measurement of the sweep beside its closed form and
/// verdicts; metrics that do not fit side by side go into a second table below. Then what does not
/// hold (the first ten), and the counts.
std::string terminal_table(const StudyResult& study, const TableStyle& style = {});

}  // namespace hookpoint::studies
