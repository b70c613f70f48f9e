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

#include "output/files/result_folder.h"
#include "studies/measure/engine_table.h"
#include "studies/plan/plan.h"
#include "studies/results/result.h"
#include "studies/run/provenance.h"
#include "studies/run/runs.h"

namespace hookpoint::studies {

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

/// Runs all rows of `plan`, then the timing metrics alone, and writes results.csv, timing.csv (with
/// timing metrics), experiment.hook, scene.hook, provenance.json, traces/ and files.json, after
/// what an earlier run left in the folder. Each row is isolated: one that diverges or cannot run is
/// a row with that status. `stop` may be set at any time, also from a signal handler. Throws
/// output::FolderError when the folder is not to be had, output::FileError and StoreError when the
/// disk refuses.
StudyRun run_study(const StudyPlan& plan, const EngineTable& engines, const RunOptions& options,
                   const std::atomic<bool>& stop);

}  // namespace hookpoint::studies
