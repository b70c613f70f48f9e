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
#include "studies/run/run.h"
#include "studies/run/run_store.h"
#include "studies/tune/scene.h"

namespace hookpoint::studies {

/// One run that is asked for.
struct WantedRun {
  std::vector<ConstantSetting> constants;
  std::uint64_t seed = 1;
};

/// What it gave.
struct WantedOutcome {
  std::string status = "ok";
  std::vector<std::optional<double>> measured;  ///< one a metric of the plan
};

/// What the runs of all batches have in common. All outlives the batches.
struct BatchPlan {
  const TuneScene& scene;
  const StudyPlan& runs;  ///< metrics, settle, duration; its rows do not count
  std::string hash;       ///< of all that decides a run but its constants and seed
};

/// `stop` was set: what the batch had finished, one a request.
struct BatchInterrupted : std::exception {
  explicit BatchInterrupted(std::vector<std::optional<WantedOutcome>> all)
      : finished(std::move(all)) {}
  const char* what() const noexcept override { return "interrupted"; }
  std::vector<std::optional<WantedOutcome>> finished;
};

class RunBatches {
 public:
  /// Finished runs are kept in the store of `folder`; with `options.resume` those that are there
  /// are not made again. `total`: runs that will be asked for, for the progress. Throws StoreError.
  RunBatches(BatchPlan plan, const EngineTable& engines, const RunOptions& options,
             const std::filesystem::path& folder, std::size_t total, const std::atomic<bool>& stop);

  /// The outcomes in their order, whatever the number of threads. A scene that cannot
  /// be loaded so is an outcome with that status. Throws BatchInterrupted, StoreError.
  std::vector<WantedOutcome> run(std::span<const WantedRun> wanted);
  /// Runs that were announced and need not be made.
  void skip(std::size_t runs);
  /// Runs so far.
  std::size_t count() const { return identities_.size(); }

 private:
  std::string identity_of(const WantedRun& wanted) const;
  std::optional<RunRecord> execute(const WantedRun& wanted) const;
  /// For another process; nothing where its scene cannot be loaded.
  std::optional<RunRequest> request(const WantedRun& wanted) const;
  /// Nothing where the run is not finished.
  std::optional<WantedOutcome> outcome_of(std::size_t run) const;

  BatchPlan plan_;
  Measurement measurement_;
  const EngineTable& engines_;
  RunOptions options_;
  const std::atomic<bool>& stop_;
  std::shared_ptr<RunStore> store_;
  ProgressMeter meter_;
  std::vector<std::string> identities_;  ///< of all runs, in the order in which they were asked for
};

}  // namespace hookpoint::studies
