#include "studies/run/runs.h"

#include <fmt/format.h>

#include <algorithm>
#include <functional>
#include <numeric>
#include <set>
#include <string_view>
#include <utility>

#include "simulation/run/energy_watch.h"
#include "studies/measure/workers.h"
#include "studies/run/results_csv.h"

namespace hookpoint::studies {
namespace {

constexpr std::size_t runs_between_giving_back = 256;

/// What several runs have in common to say: `text` with a # for each number.
std::string kind_of(const std::string& text) {
  if (text.starts_with(simulation::energy_finding)) return std::string(simulation::energy_finding);
  std::string plain;
  for (const char c : text) {
    const bool digit = c >= '0' && c <= '9';
    if (!digit || plain.empty() || plain.back() != '#') plain += digit ? '#' : c;
  }
  return plain;
}

}  // namespace

CachedRuns::CachedRuns(std::string owner, RunOptions options, const std::filesystem::path& folder,
                       std::size_t total, const std::atomic<bool>& stop)
    : owner_(std::move(owner)), options_(std::move(options)), stop_(stop), store_(options_.store) {
  if (!store_) store_ = std::make_shared<RunStore>(folder / store_folder, options_.resume);
  progress_.total = total;
}

void CachedRuns::advance(bool resumed) {
  const std::lock_guard lock(mutex_);
  ++progress_.done;
  if (resumed) ++progress_.resumed;
  const std::chrono::duration<double> elapsed = std::chrono::steady_clock::now() - start_;
  const auto worked = static_cast<double>(progress_.done - progress_.resumed);
  const auto left = static_cast<double>(progress_.total - progress_.done);
  progress_.seconds_left = worked > 0. ? elapsed.count() / worked * left : 0.;
  if (options_.progress) options_.progress(progress_);
}

void CachedRuns::skip(std::size_t runs) {
  for (std::size_t i = 0; i < runs; ++i) advance(true);
}

/// Of `numbers` those that the store has not; it then knows whose the others are.
CachedRuns::Numbers CachedRuns::take_finished(const RunBatch& batch, const Numbers& numbers) {
  Numbers left;
  for (const std::size_t number : numbers) {
    const auto record = store_->load(identity(number));
    if (!record || record->lost_engine() || !batch.complete(number, *record)) {
      left.push_back(number);
      continue;
    }
    if (store_->assigned(owner_, first_ + number) != identity(number))
      store_->assign(owner_, first_ + number, identity(number));
    if (batch.done) batch.done(number);
    advance(true);
  }
  return left;
}

/// Tells of runs that were made before, as something else than what they are now.
void CachedRuns::tell_of_others(const Numbers& left) const {
  if (!options_.tell) return;
  const std::set<std::string_view> wanted(identities_.begin(), identities_.end());
  const auto others = std::ranges::count_if(left, [&](std::size_t number) {
    const auto before = store_->assigned(owner_, first_ + number);
    return before && (*before == identity(number) || !wanted.contains(*before));
  });
  if (others > 0)
    options_.tell(fmt::format(
        "{} of the finished rows {} of another study, scene, input file, program or engine, or "
        "damaged: {} again",
        others, others == 1 ? "is" : "are", others == 1 ? "it is run" : "they are run"));
}

/// The first of each identity, the others into `again`.
CachedRuns::Numbers CachedRuns::first_of_each(const Numbers& numbers, Numbers& again) const {
  Numbers first;
  std::set<std::string_view> known;
  for (const std::size_t number : numbers)
    (known.insert(identity(number)).second ? first : again).push_back(number);
  return first;
}

/// Into the store and to whoever listens.
void CachedRuns::keep(const RunBatch& batch, std::size_t number, RunRecord record) {
  store_->save(owner_, first_ + number, identity(number), std::move(record));
  if (batch.done) batch.done(number);
  advance(false);
}

/// What has a request goes away, the rest is run here.
bool CachedRuns::make(const RunBatch& batch, const Numbers& numbers) {
  Numbers here, away;
  for (const std::size_t number : numbers)
    (options_.remote != nullptr && batch.request && batch.request(number) ? away : here)
        .push_back(number);
  const bool all = work_through(here.size(), options_.jobs, [&](std::size_t i) {
    auto record = batch.make(here[i]);
    if (record) keep(batch, here[i], std::move(*record));
    if ((i + 1) % runs_between_giving_back == 0) give_memory_back();
    return record.has_value();
  });
  if (!all || away.empty()) return all;
  return options_.remote->run(
      away.size(), [&](std::size_t index) { return *batch.request(away[index]); },
      [&](std::size_t index, RunRecord record) { keep(batch, away[index], std::move(record)); },
      stop_);
}

bool CachedRuns::run(const RunBatch& batch) {
  first_ = identities_.size();
  for (std::size_t i = 0; i < batch.count; ++i) identities_.push_back(batch.identity(i));
  Numbers left(batch.count);
  std::iota(left.begin(), left.end(), 0);
  if (batch.length)
    std::ranges::stable_sort(left, std::greater<>(),
                             [&](std::size_t i) { return batch.length(i); });
  left = take_finished(batch, left);
  tell_of_others(left);
  while (!left.empty()) {
    Numbers again;
    if (!make(batch, first_of_each(left, again))) return false;
    left = take_finished(batch, again);
  }
  return true;
}

std::vector<std::optional<RunRecord>> CachedRuns::records(const RunBatch& batch) {
  const bool all = run(batch);
  std::vector<std::optional<RunRecord>> records(batch.count);
  for (std::size_t i = 0; i < batch.count; ++i) {
    records[i] = store_->numbers(identity(i));
    if (records[i] && !batch.complete(i, *records[i])) records[i].reset();
    if (all && !records[i]) throw StoreError("a run that was just stored cannot be read back");
  }
  return records;
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
