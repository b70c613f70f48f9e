#include "studies/calibrate/fits.h"

#include "studies/calibrate/model.h"

namespace hookpoint::studies {
namespace {

/// Names of a fit's numbers in the store.
constexpr const char* error_name = "error";
constexpr const char* held_out_name = "held_out";
constexpr const char* models_name = "models";
constexpr const char* end_name = "end";
constexpr const char* wide_end_name = "wide_end";

std::string share_name(std::size_t number) { return "share_" + std::to_string(number); }
std::string apart_name(std::size_t number) { return "apart_" + std::to_string(number); }
std::string case_name(std::size_t number) { return "case_" + std::to_string(number); }

RunRecord record_of_fit(const FitOutcome& outcome) {
  RunRecord record;
  record.status = outcome.status;
  record.values[error_name].measured = outcome.error;
  record.values[held_out_name].measured = outcome.held_out;
  record.values[models_name].measured = static_cast<double>(outcome.models);
  for (std::size_t i = 0; i < outcome.point.size(); ++i)
    record.values[share_name(i)].measured = outcome.point[i];
  for (std::size_t i = 0; i < outcome.cases.size(); ++i)
    record.values[case_name(i)].measured = outcome.cases[i];
  for (std::size_t i = 0; i < outcome.apart.size(); ++i)
    record.values[apart_name(i)].measured = outcome.apart[i];
  if (outcome.end) record.values[end_name].measured = outcome.end;
  if (outcome.wide_end) record.values[wide_end_name].measured = outcome.wide_end;
  return record;
}

bool is_fit(const RunRecord& record) {
  const auto models = record.values.find(models_name);
  return models != record.values.end() && models->second.measured &&
         record.values.contains(error_name) && record.values.contains(held_out_name);
}

FitOutcome fit_in(const RunRecord& record) {
  const auto value = [&](const std::string& name) { return record.values.at(name).measured; };
  FitOutcome outcome{record.status,        value(error_name),
                     value(held_out_name), static_cast<std::size_t>(*value(models_name)),
                     UnitPoint{},          {}};
  for (std::size_t i = 0; record.values.contains(share_name(i)); ++i)
    outcome.point.push_back(value(share_name(i)).value_or(0.));
  for (std::size_t i = 0; record.values.contains(case_name(i)); ++i)
    outcome.cases.push_back(value(case_name(i)).value_or(0.));
  for (std::size_t i = 0; record.values.contains(apart_name(i)); ++i)
    outcome.apart.push_back(value(apart_name(i)).value_or(0.));
  if (record.values.contains(end_name)) outcome.end = value(end_name);
  if (record.values.contains(wide_end_name)) outcome.wide_end = value(wide_end_name);
  return outcome;
}

}  // namespace

std::vector<std::optional<FitOutcome>> run_fits(CachedRuns& runs, const FitBatch& fits) {
  RunBatch batch;
  batch.count = fits.count;
  batch.identity = fits.identity;
  batch.make = [&](std::size_t number) -> std::optional<RunRecord> {
    try {
      return record_of_fit(fits.work(number));
    } catch (const CalibrationInterrupted&) {
      return std::nullopt;
    }
  };
  batch.complete = [](std::size_t, const RunRecord& record) { return is_fit(record); };
  std::vector<std::optional<FitOutcome>> outcomes;
  for (const auto& record : runs.records(batch))
    outcomes.push_back(record ? std::optional(fit_in(*record)) : std::nullopt);
  return outcomes;
}

}  // namespace hookpoint::studies
