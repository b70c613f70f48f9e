// A Table block on the terminal.
#pragma once

#include <string>

#include "studies/report/terminal_table.h"
#include "studies/results/pivot.h"

namespace hookpoint::studies {

/// Its title, what it is the mean over, and its cells: "mean (least .. largest) / closed form".
/// Columns that are wider than the terminal go on below.
std::string terminal_pivot(const Pivot& pivot, const TableStyle& style);

}  // namespace hookpoint::studies
