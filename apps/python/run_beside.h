// Long work that Ctrl-C ends.
#pragma once

#include <pybind11/pybind11.h>

#include <atomic>
#include <chrono>
#include <future>
#include <optional>
#include <utility>

#include "apps/python/gil.h"

namespace hookpoint::python {

/// Does `work` in a thread of its own (it starts others) without the GIL, while this one looks for
/// signals: one sets the `stop` that `work` gets, and is thrown once `work` has ended.
template <class Work>
auto run_beside(const Work& work) {
  std::atomic<bool> stop{false};
  std::optional<pybind11::error_already_set> interrupt;
  WithoutGil others_run;
  auto running = std::async(std::launch::async, [&] { return work(stop); });
  while (running.wait_for(std::chrono::milliseconds(50)) != std::future_status::ready) {
    if (interpreter_ends()) {
      stop = true;
      running.wait();
      wait_for_the_end();
    }
    const WithGil ours(others_run);
    if (interrupt || PyErr_CheckSignals() == 0) continue;
    interrupt.emplace();
    stop = true;
  }
  auto result = running.get();
  if (interrupt) throw std::move(*interrupt);
  return result;
}

}  // namespace hookpoint::python
