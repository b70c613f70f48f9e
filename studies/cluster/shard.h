// What a task of a cluster does: it makes the runs of a list and leaves a journal.
#pragma once

#include <atomic>

#include "studies/cluster/journal.h"
#include "studies/cluster/run_list.h"

namespace hookpoint::studies {

/// Makes the runs of `list` that `journal` has not, by `jobs` threads. `library`: with the classes
/// of their plugins. False when `stop` was set meanwhile. Throws RunListError when a run is not the
/// one that was requested: another program or engine, or files that were changed; output::FileError
/// when the disk refuses.
bool run_shard(const RunList& list, Journal& journal, language::Library& library,
               const EngineTable& engines, int jobs, const std::atomic<bool>& stop);

}  // namespace hookpoint::studies
