// Tables of results as numpy arrays.
#pragma once

#include <pybind11/pybind11.h>

#include "studies/task/result_values.h"

namespace hookpoint::python {

/// What a task leaves. A table is a dict of arrays by title: of numbers, NaN where a cell is empty,
/// or of words. A Table block is {"title", "note", "down", "across", "metric": words, "rows",
/// "columns": labels, "values": the cells' means, rows x columns, NaN where there is none}; a block
/// that judged or showed nothing is {"kind", "name", "why", "fault"}.
pybind11::dict dict_of(const studies::ResultValues& values);

}  // namespace hookpoint::python
