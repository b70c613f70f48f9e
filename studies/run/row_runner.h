// The rows of a plan by several threads, each once, kept on disk as they finish.
#pragma once

#include <atomic>
#include <chrono>
#include <functional>
#include <mutex>
#include <span>
#include <string>
#include <vector>

#include "studies/run/execute.h"
#include "studies/run/row_store.h"
#include "studies/run/run.h"

namespace hookpoint::studies {

/// Counts finished rows and tells the caller, one thread at a time.
class ProgressMeter {
 public:
  ProgressMeter(std::size_t total, const RunOptions& options);
  void advance(bool resumed);

 private:
  const RunOptions& options_;
  std::mutex mutex_;
  Progress progress_;
  std::chrono::steady_clock::time_point start_ = std::chrono::steady_clock::now();
};

/// How a row of the plan is run, and what it leaves.
struct RowWork {
  std::function<std::optional<RowOutcome>(std::size_t row)> execute;  ///< nothing: interrupted
  std::function<std::string(std::size_t row)> identity;  ///< of the run (StudyPlan::identity_of)
  std::function<std::size_t(std::size_t row)> metrics;   ///< how many values an outcome has
  std::size_t plots = 0;                                 ///< how many traces
  /// Hears of each outcome, from any thread; may be none.
  std::function<void(std::size_t row, const RowOutcome& outcome)> done{};
};

/// All rows of `order` by `options.jobs` workers, each outcome into its own slot; with
/// `options.resume` those that the store has are not run again, and `options.tell` hears of those
/// that it has of other runs. False when interrupted: what is finished is in the store. Rethrows
/// what a worker throws.
bool run_rows(std::span<const std::size_t> order, const RowWork& work, const RunOptions& options,
              const RowStore& store, ProgressMeter& meter, std::vector<RowOutcome>& outcomes);

/// What calls `options.row_done` with what `assemble` makes of an outcome; nothing where nobody
/// listens. `options` outlives it.
std::function<void(std::size_t row, const RowOutcome& outcome)> tell_rows(
    const RunOptions& options,
    std::function<RunResult(std::size_t row, const RowOutcome& outcome)> assemble);

/// What the rows have to say: each once, with the first row that says so and how many others do,
/// whatever the numbers in it.
std::vector<std::string> collect_notices(
    const std::vector<RowOutcome>& outcomes,
    const std::function<std::string(std::size_t row)>& name_of);

}  // namespace hookpoint::studies
