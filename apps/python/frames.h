// Results as pandas.DataFrames, where the user requests them.
#pragma once

#include <pybind11/pybind11.h>

namespace hookpoint::python {

class Frames {
 public:
  /// Throws hookpoint.Error where they are wanted and pandas is not installed: before anything
  /// runs.
  explicit Frames(bool wanted);
  /// `results` with a DataFrame in the place of every table: a dict of columns, and a Table block,
  /// whose frame has the rows' and columns' labels.
  pybind11::dict of(const pybind11::dict& results) const;

 private:
  pybind11::object frame_of(const pybind11::dict& table) const;
  pybind11::object make_;  ///< pandas.DataFrame; null: not wanted
};

}  // namespace hookpoint::python
