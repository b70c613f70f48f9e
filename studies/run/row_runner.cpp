#include "studies/run/row_runner.h"

#include <fmt/format.h>

#include <algorithm>
#include <exception>
#include <map>
#include <memory>
#include <set>
#include <thread>

#include "simulation/run/energy_watch.h"

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

namespace {

/// What several rows have in common to say: `text` with a # for each number.
std::string kind_of(const std::string& text) {
  if (text.starts_with(simulation::energy_finding)) return std::string(simulation::energy_finding);
  std::string plain;
  for (const char c : text) {
    const bool digit = c >= '0' && c <= '9';
    if (!digit || plain.empty() || plain.back() != '#') plain += digit ? '#' : c;
  }
  return plain;
}

void on_one_line(std::string& text) { std::ranges::replace(text, '\n', ' '); }

/// Takes what the store has of the rows; those that are left to run.
std::vector<std::size_t> take_finished(std::span<const std::size_t> order, const RowWork& work,
                                       const RunOptions& options, const RowStore& store,
                                       ProgressMeter& meter, std::vector<RowOutcome>& outcomes) {
  std::vector<std::size_t> left;
  std::size_t others = 0;
  for (const std::size_t row : order) {
    auto outcome = store.load(row, work.identity(row), work.metrics(row), work.plots);
    if (outcome) {
      outcomes[row] = std::move(*outcome);
      if (work.done) work.done(row, outcomes[row]);
      meter.advance(true);
      continue;
    }
    if (store.has(row)) ++others;
    left.push_back(row);
  }
  if (others > 0 && options.tell)
    options.tell(fmt::format(
        "{} of the finished rows {} of another study, scene, input file, program or engine, or "
        "damaged: {} anew",
        others, others == 1 ? "is" : "are", others == 1 ? "it is run" : "they are run"));
  return left;
}

}  // namespace

bool run_rows(std::span<const std::size_t> order, const RowWork& work, const RunOptions& options,
              const RowStore& store, ProgressMeter& meter, std::vector<RowOutcome>& outcomes) {
  const std::vector<std::size_t> left =
      options.resume ? take_finished(order, work, options, store, meter, outcomes)
                     : std::vector<std::size_t>(order.begin(), order.end());
  std::atomic<std::size_t> next{0};
  std::atomic<bool> cut_short{false};
  std::exception_ptr failure;
  std::mutex failure_mutex;
  const auto run = [&] {
    try {
      for (std::size_t i = next++; i < left.size() && !cut_short; i = next++) {
        const std::size_t row = left[i];
        auto outcome = work.execute(row);
        if (!outcome) {
          cut_short = true;
          return;
        }
        on_one_line(outcome->status);
        for (std::string& notice : outcome->notices) on_one_line(notice);
        store.save(row, work.identity(row), *outcome);
        outcomes[row] = std::move(*outcome);
        if (work.done) work.done(row, outcomes[row]);
        meter.advance(false);
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

std::function<void(std::size_t row, const RowOutcome& outcome)> tell_rows(
    const RunOptions& options,
    std::function<RunResult(std::size_t row, const RowOutcome& outcome)> assemble) {
  if (!options.row_done) return {};
  return [&options, assemble = std::move(assemble), telling = std::make_shared<std::mutex>()](
             std::size_t row, const RowOutcome& outcome) {
    const RunResult result = assemble(row, outcome);
    const std::lock_guard lock(*telling);
    options.row_done(row, result);
  };
}

std::vector<std::string> collect_notices(
    const std::vector<RowOutcome>& outcomes,
    const std::function<std::string(std::size_t row)>& name_of) {
  struct Notice {
    std::size_t row;
    std::string text;
    std::set<std::size_t> rows;
  };
  std::vector<Notice> found;
  std::map<std::string, std::size_t> places;
  for (std::size_t i = 0; i < outcomes.size(); ++i) {
    for (const std::string& notice : outcomes[i].notices) {
      const auto [place, is_new] = places.try_emplace(kind_of(notice), found.size());
      if (is_new) found.push_back({i, notice, {}});
      found[place->second].rows.insert(i);
    }
  }
  std::vector<std::string> notices;
  for (const Notice& notice : found) {
    const std::size_t others = notice.rows.size() - 1;
    notices.push_back(name_of(notice.row) + ": " + notice.text +
                      (others == 0   ? ""
                       : others == 1 ? " (so does 1 more run)"
                                     : fmt::format(" (so do {} more runs)", others)));
  }
  return notices;
}

}  // namespace hookpoint::studies
