#include "apps/python/gil.h"

#include <cxxabi.h>
#include <pthread.h>
#include <unistd.h>

#include <atomic>
#include <chrono>
#include <thread>

namespace hookpoint::python {
namespace {

namespace py = pybind11;

std::atomic<bool> ends{false};
/// Threads that found that the interpreter lives and have not got the GIL yet.
std::atomic<int> taking{0};
std::thread::id ending_thread;

/// Called by Python's atexit, which is before the interpreter ends any thread. Threads that are
/// about to take the GIL get it first: from then on none takes it.
void begin_to_end() {
  ending_thread = std::this_thread::get_id();
  ends = true;
  PyThreadState* const thread = PyEval_SaveThread();
  while (taking > 0) std::this_thread::sleep_for(std::chrono::milliseconds(1));
  PyEval_RestoreThread(thread);
}

}  // namespace

void watch_the_interpreter() {
  py::module_::import("atexit").attr("register")(py::cpp_function(begin_to_end));
  // The other threads do not exist in a child process.
  pthread_atfork(nullptr, nullptr, [] { taking = 0; });
}

bool interpreter_ends() { return ends && std::this_thread::get_id() != ending_thread; }

void wait_for_the_end() {
  for (;;) pause();
}

PyObject* call(const py::object& function, const py::object& argument) {
  try {
    return PyObject_CallOneArg(function.ptr(), argument.ptr());
  } catch (abi::__forced_unwind&) {
    // The interpreter ended this thread while it ran code of Python. What lies further out must not
    // be taken down without the GIL.
    wait_for_the_end();
  }
}

void WithoutGil::take() {
  ++taking;
  if (interpreter_ends()) {
    --taking;
    wait_for_the_end();
  }
  PyEval_RestoreThread(thread_);
  --taking;
}

}  // namespace hookpoint::python
