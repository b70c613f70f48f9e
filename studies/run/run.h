// Runs a plan: in parallel, with identical results for any number of threads, and writes the
// study's folder.
#pragma once

#include <atomic>
#include <cstddef>
#include <filesystem>
#include <functional>
#include <memory>
#include <span>
#include <string>

#include "output/result_folder.h"
#include "studies/engine_table.h"
#include "studies/plan/plan.h"
#include "studies/result.h"
#include "studies/run/provenance.h"
#include "studies/run/run_request.h"
#include "studies/run/run_store.h"

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
  std::function<void(const std::string&)> tell;   ///< what the user should know
  /// A row that has finished, or was taken over from an earlier run; one call at a time, from any
  /// thread. What only all rows together tell is missing: its verdicts where they need other rows,
  /// metrics of several runs, timing.
  std::function<void(std::size_t row, const RunResult& result)> row_done{};
  /// Of several studies that share their runs; none: one in the study's folder. It then has the
  /// runs of before with `resume` alone.
  std::shared_ptr<RunStore> store{};
  RemoteRuns* remote = nullptr;  ///< who makes the runs; null: this process
};

struct StudyRun {
  StudyResult result;
  Provenance provenance;
  std::filesystem::path folder;  ///< where the files are
  /// Locks the folder for what `study_files` names; who has written all calls finish(). None of a
  /// study that was interrupted.
  std::unique_ptr<output::ResultFolder> files;
  std::vector<std::string> notices;  ///< of engines, none twice, with the first run that gave it
  bool interrupted = false;  ///< `stop` was set: finished rows are kept, no tables are written
};

/// How many of the plan's runs another process could make: those that have an engine.
std::size_t remote_runs(const StudyPlan& plan, const EngineTable& engines);

/// The store of runs that `options` ask for, for results in `folder`. Throws StoreError.
std::shared_ptr<RunStore> open_store(const RunOptions& options,
                                     const std::filesystem::path& folder);

/// Runs all rows of `plan`, then the timing metrics alone, and writes results.csv, timing.csv (with
/// timing metrics), experiment.hook, scene.hook, provenance.json, traces/ and files.json, after
/// what an earlier run left in the folder. Each row is isolated: one that diverges or cannot run is
/// a row with that status. `stop` may be set at any time, also from a signal handler. Throws
/// output::FolderError when the folder is not to be had, output::FileError and StoreError when the
/// disk refuses.
StudyRun run_study(const StudyPlan& plan, const EngineTable& engines, const RunOptions& options,
                   const std::atomic<bool>& stop);

}  // namespace hookpoint::studies
