// The exceptions of the module.
#pragma once

#include <pybind11/pybind11.h>

#include <string>

#include "language/diagnostics.h"
#include "simulation/engine_interface/engine.h"

namespace hookpoint::python {

/// Adds hookpoint.Error and its kinds to the module, and turns what our code throws into them.
void add_errors(pybind11::module_& module);

/// A UserWarning, which is an exception if the program wants it so.
void warn(const std::string& message);
/// Throws hookpoint.Error.
[[noreturn]] void throw_error(const std::string& message);
/// Throws hookpoint.FileError, which holds all of them. Needs the GIL.
[[noreturn]] void throw_diagnostics(const language::Diagnostics& diagnostics);
/// Throws hookpoint.RunError for a step that was not taken.
[[noreturn]] void throw_failure(const simulation::StepStatus& status);

}  // namespace hookpoint::python
