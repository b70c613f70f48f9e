// Tasks run from Python: tables as numpy arrays.
#pragma once

#include <pybind11/pybind11.h>

#include "apps/shared/task_file.h"

namespace hookpoint::python {

/// Every task of the file that the command runs, by name: its values (studies/task/*_task.cpp),
/// tables as columns. With `out` that folder gets what the command leaves. Throws hookpoint.Error
/// and FileError, and KeyboardInterrupt.
pybind11::dict run_tasks(const application::TaskCommand& command,
                         const application::TaskArguments& arguments);

}  // namespace hookpoint::python
