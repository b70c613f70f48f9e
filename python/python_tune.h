// Tunings and calibrations run from Python: tables as numpy arrays.
#pragma once

#include <pybind11/pybind11.h>

#include "application/study_arguments.h"

namespace hookpoint::python {

/// Every Tune and Calibrate of the file, by label. A Tune: {"table": its evaluations, "pareto",
/// "sobol": columns, "recommended": recommended.json as a dict, "material": text of the Material,
/// "holds": whether it meets the requirements}; a Calibrate: {"table": its constants,
/// "correlations", "fits", "folds", "curves": columns, "materials": texts by subject}; of both
/// "notices". With `out` that folder gets what `hookpoint tune` leaves. Throws hookpoint.Error and
/// FileError, and KeyboardInterrupt.
pybind11::dict run_tunings(const application::StudyArguments& arguments);

}  // namespace hookpoint::python
