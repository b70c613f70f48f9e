// Fits by several threads, each kept in the store of the folder as it finishes.
#pragma once

#include <atomic>
#include <cstddef>
#include <filesystem>
#include <functional>
#include <memory>
#include <optional>
#include <string>
#include <vector>

#include "studies/calibrate/least_squares.h"
#include "studies/run/row_runner.h"
#include "studies/run/run.h"
#include "studies/run/run_store.h"

namespace hookpoint::studies {

/// What a fit leaves, or a look at one place.
struct FitOutcome {
  std::string status = "ok";
  std::optional<double> error;     ///< root mean square of the residuals; nothing: no run
  std::optional<double> held_out;  ///< the same of what a fold has held out
  std::size_t models = 0;          ///< places at which the cases were run
  Shares place;                    ///< where it ended; empty: nowhere
  std::vector<double> cases{};     ///< error of each case; empty: not told apart
  std::optional<double> end{};     ///< of a profile: the share at which the interval ends
};

/// Some fits of one kind.
struct FitBatch {
  std::size_t count = 0;
  /// What decides the numbers of each, as a hash.
  std::function<std::string(std::size_t number)> identity;
  /// From any thread. May throw CalibrationInterrupted.
  std::function<FitOutcome(std::size_t number)> work;
};

class FitRows {
 public:
  /// Kept for `study` in the store of `folder`; with `options.resume` those that are there are not
  /// made again. `total`: fits that will be asked for. Throws StoreError.
  FitRows(std::string study, const RunOptions& options, const std::filesystem::path& folder,
          std::size_t total, const std::atomic<bool>& stop);

  /// The outcomes in order, whatever the number of threads; when interrupted nothing in the places
  /// of those that are not finished. Throws StoreError.
  std::vector<std::optional<FitOutcome>> run(const FitBatch& batch);
  /// Fits that were announced and are not made.
  void skip(std::size_t fits);
  std::size_t count() const { return identities_.size(); }
  int jobs() const { return options_.jobs; }

 private:
  std::string study_;
  RunOptions options_;
  const std::atomic<bool>& stop_;
  std::shared_ptr<RunStore> store_;
  ProgressMeter meter_;
  std::vector<std::string> identities_;  ///< of all fits, in the order in which they were asked for
};

}  // namespace hookpoint::studies
