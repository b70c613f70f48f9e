// What Python's own means of copying ask of a World and a Batch: copy, deepcopy, pickle, and `with`.
#pragma once

#include <pybind11/pybind11.h>

#include "apps/python/python_batch.h"
#include "apps/python/python_world.h"

namespace hookpoint::python {

/// A copy of either kind, and what is unpickled, continue bit for bit as the original does. A pickle
/// has the file's place or text, its settings and the state: not the file, which is read again.
void add_copying(pybind11::class_<PythonWorld>& world);
void add_copying(pybind11::class_<PythonBatch>& batch);

}  // namespace hookpoint::python
