#include "apps/python/errors.h"

#include <new>
#include <sstream>
#include <system_error>

#include "output/files/file.h"
#include "output/files/result_folder.h"
#include "simulation/run/loop.h"
#include "studies/plan/plan.h"
#include "studies/run/run_store.h"

namespace hookpoint::python {
namespace {

namespace py = pybind11;

// Kept for good: classes of the module, which is never unloaded.
PyObject* error_class = nullptr;
PyObject* file_error_class = nullptr;
PyObject* run_error_class = nullptr;

PyObject* add_class(py::module_& module, const char* name, const char* doc, PyObject* base) {
  const std::string full = std::string("hookpoint.") + name;
  PyObject* made = PyErr_NewExceptionWithDoc(full.c_str(), doc, base, nullptr);
  if (made == nullptr) throw py::error_already_set();
  module.add_object(name, py::reinterpret_borrow<py::object>(made));
  return made;
}

py::object make(PyObject* type, const std::string& message) {
  return py::reinterpret_borrow<py::object>(type)(message);
}

[[noreturn]] void raise(const py::object& error) {
  PyErr_SetObject(reinterpret_cast<PyObject*>(Py_TYPE(error.ptr())), error.ptr());
  throw py::error_already_set();
}

py::dict entry(const language::Diagnostic& diagnostic) {
  constexpr const char* names[] = {"error", "warning", "note"};
  py::dict entry;
  entry["severity"] = names[static_cast<int>(diagnostic.severity)];
  entry["message"] = diagnostic.message;
  entry["file"] = py::none();
  entry["line"] = py::none();
  entry["column"] = py::none();
  if (diagnostic.position.file != nullptr) {
    const language::LineColumn place = language::line_and_column(diagnostic.position);
    entry["file"] = diagnostic.position.file->path;
    entry["line"] = place.line;
    entry["column"] = place.column;
  }
  return entry;
}

}  // namespace

void add_errors(py::module_& module) {
  error_class = add_class(
      module, "Error", "What hookpoint raises; its message says what to change.", PyExc_Exception);
  file_error_class =
      add_class(module, "FileError",
                "A .hook file is wrong. `diagnostics`: a list of dicts with severity, message, "
                "file, line, column.",
                error_class);
  run_error_class = add_class(module, "RunError",
                              "A step could not be taken: `time` [s], `body`, `advice`. What was "
                              "recorded before is World.recorded.",
                              error_class);
  // NOLINTNEXTLINE(performance-unnecessary-value-param): the signature is pybind11's.
  py::register_exception_translator([](std::exception_ptr thrown) {
    try {
      if (thrown) std::rethrow_exception(thrown);
    } catch (const simulation::ExperimentError& error) {
      PyErr_SetString(error_class, error.what());
    } catch (const output::FolderError& error) {
      PyErr_SetString(error_class, error.what());
    } catch (const studies::ChangedInput& error) {
      PyErr_SetString(error_class, error.what());
    } catch (const output::FileError& error) {
      PyErr_SetString(PyExc_OSError, error.what());
    } catch (const studies::StoreError& error) {
      PyErr_SetString(PyExc_OSError, error.what());
    } catch (const std::bad_alloc&) {
      PyErr_SetString(PyExc_MemoryError,
                      "the system gives no more memory: fewer worlds or a smaller scene need less");
    } catch (const std::system_error& error) {
      // Of threads: files have errors of their own.
      PyErr_SetString(error_class, (std::string("the system starts no more threads: ") +
                                    error.what() + "; use fewer threads or jobs")
                                       .c_str());
    }
  });
}

void warn(const std::string& message) {
  if (PyErr_WarnEx(PyExc_UserWarning, message.c_str(), 1) != 0) throw py::error_already_set();
}

void throw_error(const std::string& message) { raise(make(error_class, message)); }

void throw_diagnostics(const language::Diagnostics& diagnostics) {
  std::ostringstream text;
  diagnostics.print(text, false);
  const py::object error = make(file_error_class, text.str());
  py::list all;
  for (const language::Diagnostic& diagnostic : diagnostics.all()) all.append(entry(diagnostic));
  error.attr("diagnostics") = all;
  raise(error);
}

void throw_failure(const simulation::StepStatus& status) {
  const py::object error =
      make(run_error_class, "the run stopped " + simulation::failure_text(status));
  error.attr("time") = status.time;
  error.attr("body") = status.body;
  error.attr("advice") = status.advice;
  raise(error);
}

}  // namespace hookpoint::python
