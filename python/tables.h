// Tables of results as numpy arrays.
#pragma once

#include <pybind11/pybind11.h>

#include "output/text/csv.h"
#include "studies/pivot.h"

namespace hookpoint::python {

/// A dict of arrays by title: of numbers, NaN where a cell is empty, or of words.
pybind11::dict columns_of(const output::CsvTable& table);

/// {"title", "note", "down", "across", "metric": words, "rows", "columns": labels, "values": the
/// cells' means, rows x columns, NaN where there is none}.
pybind11::dict grid_of(const studies::Pivot& pivot);

}  // namespace hookpoint::python
