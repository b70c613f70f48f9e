// Runs of a scene under many constants and seeds: what every search, sensitivity and calibration
// asks of the engines, a batch at a time.
#pragma once

#include <atomic>
#include <cstdint>
#include <exception>
#include <optional>
#include <span>
#include <string>
#include <vector>

#include "studies/engine_table.h"
#include "studies/run/execute.h"
#include "studies/run/row_runner.h"
#include "studies/run/row_store.h"
#include "studies/run/run.h"
#include "studies/tune/scene.h"

namespace hookpoint::studies {

/// One run that is asked for.
struct RunRequest {
  std::vector<ConstantSetting> constants;
  std::uint64_t seed = 1;
};

/// What the runs of all batches have in common. All outlives the batches.
struct BatchPlan {
  const TuneScene& scene;
  const StudyPlan& runs;  ///< metrics, plots, settle, duration; its rows do not count
  std::string hash;       ///< of all that decides a run but its constants and seed
};

/// `stop` was set: what the batch had finished, one a request.
struct BatchInterrupted : std::exception {
  explicit BatchInterrupted(std::vector<std::optional<RowOutcome>> all)
      : finished(std::move(all)) {}
  const char* what() const noexcept override { return "interrupted"; }
  std::vector<std::optional<RowOutcome>> finished;
};

class RunBatches {
 public:
  /// Finished runs are kept in `folder`/rows, numbered in the order in which they are asked for;
  /// with `options.resume` those that are there are not run again. `total`: runs that will be asked
  /// for, for the progress. Throws output::FileError.
  RunBatches(BatchPlan plan, const EngineTable& engines, const RunOptions& options,
             const std::filesystem::path& folder, std::size_t total, const std::atomic<bool>& stop);

  /// The outcomes in the order of the requests, whatever the number of threads. A scene that cannot
  /// be loaded so is an outcome with that status. Throws BatchInterrupted, output::FileError.
  std::vector<RowOutcome> run(std::span<const RunRequest> requests);
  /// Runs that were announced and need not be made.
  void skip(std::size_t runs);
  /// Runs so far.
  std::size_t count() const { return outcomes_.size(); }

 private:
  std::string identity_of(const RunRequest& request) const;
  std::optional<RowOutcome> execute(const RunRequest& request) const;

  BatchPlan plan_;
  const EngineTable& engines_;
  RunOptions options_;
  const std::atomic<bool>& stop_;
  RowStore store_;
  ProgressMeter meter_;
  std::vector<RowOutcome> outcomes_;
};

}  // namespace hookpoint::studies
