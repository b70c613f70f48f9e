// Runs a plan: in parallel, with identical results for any number of threads, and writes the
// study's folder.
#pragma once

#include <atomic>
#include <cstddef>
#include <filesystem>
#include <functional>
#include <span>

#include "studies/engine_table.h"
#include "studies/plan.h"
#include "studies/provenance.h"
#include "studies/result.h"

namespace hookpoint::studies {

struct Progress {
  std::size_t done = 0, total = 0;
  std::size_t resumed = 0;   ///< of `done`, those read from an earlier run
  double seconds_left = 0.;  ///< an estimate from the rows done so far
};

struct RunOptions {
  int jobs = 1;                                   ///< worker threads
  bool resume = false;                            ///< take over the finished rows of an earlier run
  std::filesystem::path folder;                   ///< of the results; empty: runs/<study>-<hash>
  std::function<void(const Progress&)> progress;  ///< one call at a time, from any thread
};

struct StudyRun {
  StudyResult result;
  Provenance provenance;
  std::filesystem::path folder;      ///< where the files are
  std::vector<std::string> notices;  ///< of engines, each with its run's name, none twice
  bool interrupted = false;  ///< `stop` was set: finished rows are kept, no tables are written
};

/// Runs all rows of `plan`, then the timing metrics alone, and writes results.csv, timing.csv (with
/// timing metrics), experiment.hook, scene.hook, provenance.json and traces/. Each row is isolated:
/// one that diverges or cannot run is a row with that status. `stop` may be set at any time, also
/// from a signal handler. Throws output::FileError when the disk refuses.
StudyRun run_study(const StudyPlan& plan, const EngineTable& engines, const RunOptions& options,
                   const std::atomic<bool>& stop);

/// While it lives, the interrupt key (SIGINT) and SIGTERM set `stop()` instead of ending the
/// program; a second one ends it.
class InterruptGuard {
 public:
  InterruptGuard();
  ~InterruptGuard();
  InterruptGuard(const InterruptGuard&) = delete;
  InterruptGuard& operator=(const InterruptGuard&) = delete;
  static const std::atomic<bool>& stop();
};

}  // namespace hookpoint::studies
