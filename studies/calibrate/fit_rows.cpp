#include "studies/calibrate/fit_rows.h"

#include <numeric>
#include <utility>

#include "studies/calibrate/model.h"

namespace hookpoint::studies {
namespace {

/// Names of a fit's numbers in the store.
constexpr const char* error_name = "error";
constexpr const char* held_out_name = "held_out";
constexpr const char* models_name = "models";
constexpr const char* end_name = "end";

std::string share_name(std::size_t number) { return "share_" + std::to_string(number); }
std::string case_name(std::size_t number) { return "case_" + std::to_string(number); }

RunRecord record_of_fit(const FitOutcome& outcome) {
  RunRecord record;
  record.status = outcome.status;
  record.values[error_name].measured = outcome.error;
  record.values[held_out_name].measured = outcome.held_out;
  record.values[models_name].measured = static_cast<double>(outcome.models);
  for (std::size_t i = 0; i < outcome.place.size(); ++i)
    record.values[share_name(i)].measured = outcome.place[i];
  for (std::size_t i = 0; i < outcome.cases.size(); ++i)
    record.values[case_name(i)].measured = outcome.cases[i];
  if (outcome.end) record.values[end_name].measured = outcome.end;
  return record;
}

bool is_fit(const RunRecord& record) {
  const auto models = record.values.find(models_name);
  return models != record.values.end() && models->second.measured &&
         record.values.contains(error_name) && record.values.contains(held_out_name);
}

FitOutcome fit_in(const RunRecord& record) {
  const auto value = [&](const std::string& name) { return record.values.at(name).measured; };
  FitOutcome outcome{record.status,
                     value(error_name),
                     value(held_out_name),
                     static_cast<std::size_t>(*value(models_name)),
                     Shares{},
                     {}};
  for (std::size_t i = 0; record.values.contains(share_name(i)); ++i)
    outcome.place.push_back(value(share_name(i)).value_or(0.));
  for (std::size_t i = 0; record.values.contains(case_name(i)); ++i)
    outcome.cases.push_back(value(case_name(i)).value_or(0.));
  if (record.values.contains(end_name)) outcome.end = value(end_name);
  return outcome;
}

}  // namespace

FitRows::FitRows(std::string study, const RunOptions& options, const std::filesystem::path& folder,
                 std::size_t total, const std::atomic<bool>& stop)
    : study_(std::move(study)),
      options_(options),
      stop_(stop),
      store_(open_store(options, folder)),
      meter_(total, options_) {}

std::vector<std::optional<FitOutcome>> FitRows::run(const FitBatch& batch) {
  const std::size_t first = identities_.size();
  for (std::size_t i = 0; i < batch.count; ++i) identities_.push_back(batch.identity(i));
  std::vector<std::size_t> order(batch.count);
  std::iota(order.begin(), order.end(), first);
  const auto execute = [&](std::size_t row) -> std::optional<RunRecord> {
    try {
      return record_of_fit(batch.work(row - first));
    } catch (const CalibrationInterrupted&) {
      return std::nullopt;
    }
  };
  const RowWork work{study_, identities_, execute,
                     [](std::size_t, const RunRecord& record) { return is_fit(record); }};
  const bool all = run_rows(order, work, options_, *store_, meter_, stop_);
  std::vector<std::optional<FitOutcome>> finished;
  for (const std::size_t row : order) {
    const auto record = store_->numbers(identities_[row]);
    const bool there = record && is_fit(*record);
    if (all && !there) throw StoreError("a fit that was just kept cannot be read back");
    finished.push_back(there ? std::optional(fit_in(*record)) : std::nullopt);
  }
  return finished;
}

void FitRows::skip(std::size_t fits) {
  for (std::size_t i = 0; i < fits; ++i) meter_.advance(true);
}

}  // namespace hookpoint::studies
