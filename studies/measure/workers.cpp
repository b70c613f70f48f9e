#include "studies/measure/workers.h"

#include <algorithm>
#include <atomic>
#include <exception>
#include <mutex>
#include <thread>
#include <vector>

#if defined(__GLIBC__)
#include <malloc.h>
#endif

namespace hookpoint::studies {

void give_memory_back() {
#if defined(__GLIBC__)
  malloc_trim(0);
#endif
}

bool work_through(std::size_t count, int jobs, const std::function<bool(std::size_t)>& work) {
  std::atomic<std::size_t> next{0};
  std::atomic<bool> cut_short{false};
  std::exception_ptr failure;
  std::mutex mutex;
  const auto run = [&] {
    try {
      for (std::size_t i = next++; i < count && !cut_short; i = next++)
        if (!work(i)) cut_short = true;
    } catch (...) {
      const std::lock_guard lock(mutex);
      failure = std::current_exception();
      cut_short = true;
    }
  };
  {
    std::vector<std::jthread> workers;
    for (int i = 0; i < std::max(1, jobs); ++i) workers.emplace_back(run);
  }
  give_memory_back();
  if (failure) std::rethrow_exception(failure);
  return !cut_short;
}

}  // namespace hookpoint::studies
