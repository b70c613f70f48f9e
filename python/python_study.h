// Studies run from Python: tables as numpy arrays.
#pragma once

#include <pybind11/pybind11.h>

#include <filesystem>
#include <optional>
#include <string>
#include <vector>

namespace hookpoint::python {

struct StudyRequest {
  std::filesystem::path file;
  bool quick = false;
  std::vector<std::string> only;             ///< subjects; none: all
  int jobs = 0;                              ///< threads; 0: one a core
  std::optional<std::filesystem::path> out;  ///< of results.csv and its like; none: nothing is kept
  bool resume = false;
  bool allow_plugins = false;
};

/// Every Study of the file, by name: {"table": columns, "timing": columns, "truths": list}. Throws
/// hookpoint.FileError, and KeyboardInterrupt.
pybind11::dict run_studies(const StudyRequest& request);

}  // namespace hookpoint::python
