// The rows of a plan, each run once, by several threads or elsewhere, kept on disk as they finish.
#pragma once

#include <atomic>
#include <chrono>
#include <functional>
#include <map>
#include <mutex>
#include <optional>
#include <span>
#include <string>
#include <vector>

#include "studies/run/run.h"
#include "studies/run/run_request.h"
#include "studies/run/run_store.h"

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
  std::string study;                                                 ///< whose rows they are
  std::span<const std::string> identity;                             ///< of each row's run
  std::function<std::optional<RunRecord>(std::size_t row)> execute;  ///< nothing: interrupted
  /// Whether a record has all that the row asks for.
  std::function<bool(std::size_t row, const RunRecord& record)> complete;
  /// The row's run for another process; nothing where it is made here. May be none.
  std::function<std::optional<RunRequest>(std::size_t row)> request{};
  /// Hears of each row that is in the store, from any thread; may be none.
  std::function<void(std::size_t row)> done{};
};

/// Sees to it that the store has the runs of all rows of `order`: those that it has are not run
/// again, and rows that are the same run have one. By `options.jobs` workers, or by
/// `options.remote`. `options.tell` hears of rows whose run is no longer what it was. False when
/// interrupted: what is finished is in the store. Rethrows what a worker throws.
bool run_rows(std::span<const std::size_t> order, const RowWork& work, const RunOptions& options,
              RunStore& store, ProgressMeter& meter, const std::atomic<bool>& stop);

/// What the rows have to say: each once, with the first row that says so and how many others do,
/// whatever the numbers in it.
class Notices {
 public:
  void add(std::size_t row, const std::vector<std::string>& notices);
  std::vector<std::string> texts(const std::function<std::string(std::size_t row)>& name_of) const;

 private:
  struct Notice {
    std::size_t row = 0;
    std::string text;
    std::size_t last_row = 0, rows = 0;
  };
  std::vector<Notice> found_;
  std::map<std::string, std::size_t> places_;
};

}  // namespace hookpoint::studies
