#include "studies/row_runner.h"

#include <algorithm>
#include <exception>
#include <thread>

namespace hookpoint::studies {

ProgressMeter::ProgressMeter(std::size_t total, const RunOptions& options) : options_(options) {
  progress_.total = total;
}

void ProgressMeter::advance(bool resumed) {
  const std::lock_guard lock(mutex_);
  ++progress_.done;
  if (resumed) ++progress_.resumed;
  const std::chrono::duration<double> elapsed = std::chrono::steady_clock::now() - start_;
  const auto worked = static_cast<double>(progress_.done - progress_.resumed);
  const auto left = static_cast<double>(progress_.total - progress_.done);
  progress_.seconds_left = worked > 0. ? elapsed.count() / worked * left : 0.;
  if (options_.progress) options_.progress(progress_);
}

bool run_rows(std::span<const std::size_t> order, const RowWork& work, const RunOptions& options,
              const RowStore& store, ProgressMeter& meter, std::vector<RowOutcome>& outcomes) {
  std::atomic<std::size_t> next{0};
  std::atomic<bool> cut_short{false};
  std::exception_ptr failure;
  std::mutex failure_mutex;
  const auto run = [&] {
    try {
      for (std::size_t i = next++; i < order.size() && !cut_short; i = next++) {
        const std::size_t row = order[i];
        auto outcome =
            options.resume ? store.load(row, work.metrics(row), work.plots) : std::nullopt;
        const bool resumed = outcome.has_value();
        if (!resumed) outcome = work.execute(row);
        if (!outcome) {
          cut_short = true;
          return;
        }
        if (!resumed) store.save(row, *outcome);
        outcomes[row] = std::move(*outcome);
        meter.advance(resumed);
      }
    } catch (...) {
      const std::lock_guard lock(failure_mutex);
      failure = std::current_exception();
      cut_short = true;
    }
  };
  {
    std::vector<std::jthread> workers;
    for (int i = 0; i < std::max(1, options.jobs); ++i) workers.emplace_back(run);
  }
  if (failure) std::rethrow_exception(failure);
  return !cut_short;
}

}  // namespace hookpoint::studies
