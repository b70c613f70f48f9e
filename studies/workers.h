// Independent pieces of work by several threads.
#pragma once

#include <cstddef>
#include <functional>

namespace hookpoint::studies {

/// Calls `work` with 0 ... count - 1, each once, from `jobs` threads. After a call that gives false
/// or throws no new one is made; false then, or what was thrown.
bool work_through(std::size_t count, int jobs, const std::function<bool(std::size_t)>& work);

}  // namespace hookpoint::studies
