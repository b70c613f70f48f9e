// Independent pieces of work by several threads.
#pragma once

#include <cstddef>
#include <functional>

namespace hookpoint::studies {

/// Gives pages that hold nothing back to the system, where the C library can: the little that a run
/// leaves lies between the much that it had, and would keep all of it. Cost: about a millisecond.
void give_memory_back();

/// Calls `work` with 0 ... count - 1, each once, from `jobs` threads. After a call that gives false
/// or throws no new one is made; false then, or what was thrown. Gives memory back at the end.
bool work_through(std::size_t count, int jobs, const std::function<bool(std::size_t)>& work);

}  // namespace hookpoint::studies
