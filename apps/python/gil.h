// The GIL, for threads that may still run when the interpreter ends. Python ends such a thread
// where it next takes the GIL, in the midst of our functions; ours wait for the end of the process
// instead.
#pragma once

#include <pybind11/pybind11.h>

namespace hookpoint::python {

/// Makes the interpreter say when it begins to end. Once, while the module is made.
void watch_the_interpreter();

/// Whether the interpreter has begun to end, for every thread except the one that ends it. Needs no
/// GIL.
bool interpreter_ends();

/// Sleeps until the process is gone.
[[noreturn]] void wait_for_the_end();

/// PyObject_CallOneArg, which returns null for an exception.
PyObject* call(const pybind11::object& function, const pybind11::object& argument);

/// Lets other threads of Python run while it lives.
class WithoutGil {
 public:
  WithoutGil() : thread_(PyEval_SaveThread()) {}
  /// Does not return once the interpreter ends.
  ~WithoutGil() { take(); }
  WithoutGil(const WithoutGil&) = delete;
  WithoutGil& operator=(const WithoutGil&) = delete;

 private:
  friend class WithGil;
  void take();
  void release() { thread_ = PyEval_SaveThread(); }
  PyThreadState* thread_;
};

/// Has the GIL again for a while.
class WithGil {
 public:
  /// Does not return once the interpreter ends.
  explicit WithGil(WithoutGil& released) : released_(released) { released_.take(); }
  ~WithGil() { released_.release(); }
  WithGil(const WithGil&) = delete;
  WithGil& operator=(const WithGil&) = delete;

 private:
  WithoutGil& released_;
};

}  // namespace hookpoint::python
