// Commands that make many runs and keep them.
#pragma once

#include <functional>

namespace hookpoint::cli {

/// The status of `work`; truth_failed, and a word of why, where what it made could not be kept: the
/// disk is full, or the store of runs refuses. A folder that cannot be had is the caller's.
int keeping_runs(const std::function<int()>& work);

}  // namespace hookpoint::cli
