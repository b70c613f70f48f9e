// Runs, each made once: by several threads or elsewhere, stored on disk as they finish, and not made
// again where the store has them. Rows of a study, candidates of a tuning and fits of a calibration
// are such runs.
#pragma once

#include <atomic>
#include <chrono>
#include <cstddef>
#include <filesystem>
#include <functional>
#include <map>
#include <memory>
#include <mutex>
#include <optional>
#include <string>
#include <vector>

#include "studies/plan/scene.h"
#include "studies/results/result.h"
#include "studies/run/execute.h"
#include "studies/run/run_store.h"

namespace hookpoint::studies {

/// A run as another process can make it.
struct RunRequest {
  std::string name;      ///< for messages
  std::string identity;  ///< run_identity: whoever makes the run finds the same
  ScenePlan scene;
  Measurement measurement;
};

/// Who makes runs elsewhere than in this process.
class RemoteRuns {
 public:
  virtual ~RemoteRuns() = default;
  using Request = std::function<RunRequest(std::size_t index)>;
  using Done = std::function<void(std::size_t index, RunRecord record)>;
  /// Makes `count` runs, those of one identity once, and hands each to `done` as it comes, one call
  /// at a time. False when `stop` was set meanwhile.
  virtual bool run(std::size_t count, const Request& request, const Done& done,
                   const std::atomic<bool>& stop) = 0;
};

struct Progress {
  std::size_t done = 0, total = 0;
  std::size_t resumed = 0;   ///< of `done`, those read from an earlier run
  double seconds_left = 0.;  ///< an estimate from the runs done so far
};

struct RunOptions {
  int jobs = 1;                                   ///< worker threads
  bool resume = false;                            ///< take over the finished runs of before
  std::filesystem::path folder;                   ///< of the results; empty: runs/<name>-<hash>
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

/// Runs of one kind, by their numbers from 0.
struct RunBatch {
  std::size_t count = 0;
  /// What decides the numbers of a run, as a hash.
  std::function<std::string(std::size_t number)> identity;
  /// Makes it, in any thread; nothing: interrupted.
  std::function<std::optional<RunRecord>(std::size_t number)> make;
  /// Whether a record has all that is required of the run.
  std::function<bool(std::size_t number, const RunRecord& record)> complete;
  /// The run for another process; nothing where it is made here. May be none.
  std::function<std::optional<RunRequest>(std::size_t number)> request{};
  /// Hears of each run that is in the store, from any thread; may be none.
  std::function<void(std::size_t number)> done{};
  /// The longest begin first, so that the last thread to finish is not far behind; none: all are
  /// alike.
  std::function<double(std::size_t number)> length{};
};

class CachedRuns {
 public:
  /// Runs are those of `owner`, one batch after the other, in the store that `options` name or that
  /// of `folder`. `total`: runs that will be requested, for the progress. `stop` and what `options`
  /// point to outlive it. Throws StoreError.
  CachedRuns(std::string owner, RunOptions options, const std::filesystem::path& folder,
             std::size_t total, const std::atomic<bool>& stop);

  /// Sees to it that the store has all runs of the batch: those that it has are not made again, and
  /// those of one identity are made once, by `options.jobs` workers or by `options.remote`.
  /// `options.tell` hears of runs that are no longer what they were. False when interrupted: what
  /// is finished is in the store. Rethrows what a worker throws.
  bool run(const RunBatch& batch);
  /// The same, and the numbers of each run, without samples of its curves; nothing in the place of
  /// one that was not finished. Throws StoreError.
  std::vector<std::optional<RunRecord>> records(const RunBatch& batch);

  /// A run that was announced is done, by somebody else or without being made.
  void advance(bool resumed);
  void skip(std::size_t runs);
  /// Runs requested so far.
  std::size_t count() const { return identities_.size(); }
  int jobs() const { return options_.jobs; }
  const std::shared_ptr<RunStore>& store() const { return store_; }

 private:
  using Numbers = std::vector<std::size_t>;
  const std::string& identity(std::size_t number) const { return identities_[first_ + number]; }
  Numbers take_finished(const RunBatch& batch, const Numbers& numbers);
  void tell_of_others(const Numbers& left) const;
  Numbers first_of_each(const Numbers& numbers, Numbers& again) const;
  void keep(const RunBatch& batch, std::size_t number, RunRecord record);
  bool make(const RunBatch& batch, const Numbers& numbers);

  std::string owner_;
  RunOptions options_;
  const std::atomic<bool>& stop_;
  std::shared_ptr<RunStore> store_;
  std::vector<std::string> identities_;  ///< of all runs, in the order of their requests
  std::size_t first_ = 0;                ///< of the present batch
  std::mutex mutex_;                     ///< of the progress
  Progress progress_;
  std::chrono::steady_clock::time_point start_ = std::chrono::steady_clock::now();
};

/// What runs have to say: each once, with the first run that says so and how many others do,
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
