#include "apps/python/frames.h"

#include <pybind11/numpy.h>

#include <algorithm>

#include "apps/python/errors.h"

namespace hookpoint::python {
namespace {

namespace py = pybind11;

/// A table is a dict whose values are arrays, all of them: a column each.
bool is_table(const py::dict& dict) {
  return !dict.empty() && std::all_of(dict.begin(), dict.end(), [](const auto& entry) {
    return py::isinstance<py::array>(entry.second);
  });
}

bool is_grid(const py::dict& dict) { return dict.contains("down") && dict.contains("across"); }

}  // namespace

Frames::Frames(bool wanted) {
  if (!wanted) return;
  try {
    make_ = py::module_::import("pandas").attr("DataFrame");
  } catch (const py::error_already_set& error) {
    if (!error.matches(PyExc_ImportError)) throw;
    throw_error("frames=True needs pandas, which this Python has not (python3-pandas)");
  }
}

py::object Frames::frame_of(const py::dict& table) const {
  if (is_table(table)) return make_(table);
  if (is_grid(table))
    return make_(table["values"], py::arg("index") = table["rows"],
                 py::arg("columns") = table["columns"]);
  return of(table);
}

py::dict Frames::of(const py::dict& results) const {
  if (!make_) return results;
  py::dict made;
  for (const auto& [name, value] : results) {
    if (py::isinstance<py::dict>(value))
      made[name] = frame_of(py::reinterpret_borrow<py::dict>(value));
    else
      made[name] = value;
  }
  return made;
}

}  // namespace hookpoint::python
