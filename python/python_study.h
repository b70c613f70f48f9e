// Studies run from Python: tables as numpy arrays.
#pragma once

#include <pybind11/pybind11.h>

#include "application/study_arguments.h"

namespace hookpoint::python {

/// Every block of the file, by name. A Study: {"table": columns, "timing": columns, "truths": list,
/// "notices": list}; a Wall: {"table", "passed", "failed", "warnings"}; a Matrix: {"table",
/// "studies": its studies by name}. With `out` that folder gets what `hookpoint study` leaves.
/// Throws hookpoint.FileError, and KeyboardInterrupt.
pybind11::dict run_studies(const application::StudyArguments& arguments);

}  // namespace hookpoint::python
