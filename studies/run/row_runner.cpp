#include "studies/run/row_runner.h"

#include <fmt/format.h>

#include <algorithm>
#include <set>
#include <string_view>
#include <utility>

#include "simulation/run/energy_watch.h"
#include "studies/workers.h"

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

using Rows = std::vector<std::size_t>;

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

/// Of `rows` those that the store has not; it then knows whose the others are.
Rows take_finished(std::span<const std::size_t> rows, const RowWork& work, RunStore& store,
                   ProgressMeter& meter) {
  Rows left;
  for (const std::size_t row : rows) {
    const std::string& identity = work.identity[row];
    const auto record = store.load(identity);
    if (!record || !work.complete(row, *record)) {
      left.push_back(row);
      continue;
    }
    if (store.assigned(work.study, row) != identity) store.assign(work.study, row, identity);
    if (work.done) work.done(row);
    meter.advance(true);
  }
  return left;
}

/// Tells of rows that were run before, as something else than what they are now.
void tell_of_others(const Rows& left, const RowWork& work, const RunOptions& options,
                    const RunStore& store) {
  if (!options.tell) return;
  const std::set<std::string_view> wanted(work.identity.begin(), work.identity.end());
  const auto others = std::ranges::count_if(left, [&](std::size_t row) {
    const auto before = store.assigned(work.study, row);
    return before && (*before == work.identity[row] || !wanted.contains(*before));
  });
  if (others > 0)
    options.tell(fmt::format(
        "{} of the finished rows {} of another study, scene, input file, program or engine, or "
        "damaged: {} anew",
        others, others == 1 ? "is" : "are", others == 1 ? "it is run" : "they are run"));
}

/// The first row of each run, the others into `again`.
Rows first_of_each(const Rows& rows, const RowWork& work, Rows& again) {
  Rows first;
  std::set<std::string_view> known;
  for (const std::size_t row : rows)
    (known.insert(work.identity[row]).second ? first : again).push_back(row);
  return first;
}

/// Into the store and to whoever listens.
void keep(std::size_t row, RunRecord record, const RowWork& work, RunStore& store,
          ProgressMeter& meter) {
  store.save(work.study, row, work.identity[row], std::move(record));
  if (work.done) work.done(row);
  meter.advance(false);
}

constexpr std::size_t runs_between_giving_back = 256;

bool run_here(const Rows& rows, const RowWork& work, const RunOptions& options, RunStore& store,
              ProgressMeter& meter) {
  return work_through(rows.size(), options.jobs, [&](std::size_t i) {
    auto record = work.execute(rows[i]);
    if (record) keep(rows[i], std::move(*record), work, store, meter);
    if ((i + 1) % runs_between_giving_back == 0) give_memory_back();
    return record.has_value();
  });
}

/// What has a request goes away, the rest is run here.
bool run_all(const Rows& rows, const RowWork& work, const RunOptions& options, RunStore& store,
             ProgressMeter& meter, const std::atomic<bool>& stop) {
  Rows here, away;
  for (const std::size_t row : rows)
    (options.remote != nullptr && work.request && work.request(row) ? away : here).push_back(row);
  if (!run_here(here, work, options, store, meter)) return false;
  if (away.empty()) return true;
  return options.remote->run(
      away.size(), [&](std::size_t index) { return *work.request(away[index]); },
      [&](std::size_t index, RunRecord record) {
        keep(away[index], std::move(record), work, store, meter);
      },
      stop);
}

}  // namespace

bool run_rows(std::span<const std::size_t> order, const RowWork& work, const RunOptions& options,
              RunStore& store, ProgressMeter& meter, const std::atomic<bool>& stop) {
  Rows left = take_finished(order, work, store, meter);
  tell_of_others(left, work, options, store);
  while (!left.empty()) {
    Rows again;
    if (!run_all(first_of_each(left, work, again), work, options, store, meter, stop)) return false;
    left = take_finished(again, work, store, meter);
  }
  return true;
}

void Notices::add(std::size_t row, const std::vector<std::string>& notices) {
  for (const std::string& notice : notices) {
    const auto [place, is_new] = places_.try_emplace(kind_of(notice), found_.size());
    if (is_new) found_.push_back({row, notice, row, 1});
    Notice& found = found_[place->second];
    if (found.last_row != row) ++found.rows;
    found.last_row = row;
  }
}

std::vector<std::string> Notices::texts(
    const std::function<std::string(std::size_t row)>& name_of) const {
  std::vector<std::string> notices;
  for (const Notice& notice : found_) {
    const std::size_t others = notice.rows - 1;
    notices.push_back(name_of(notice.row) + ": " + notice.text +
                      (others == 0   ? ""
                       : others == 1 ? " (so does 1 more run)"
                                     : fmt::format(" (so do {} more runs)", others)));
  }
  return notices;
}

}  // namespace hookpoint::studies
