#include "studies/results/seed_means.h"

#include <fmt/format.h>

#include <algorithm>
#include <map>
#include <utility>
#include <vector>

#include "studies/results/statistics.h"

namespace hookpoint::studies {
namespace {

/// Of the values that `pick` finds in each row; nothing where a row has none.
template <class Pick>
std::vector<double> values_of_rows(const StudyResult& study, std::span<const std::size_t> rows,
                                   Pick pick) {
  std::vector<double> values;
  for (const std::size_t row : rows) {
    const std::optional<double> value = pick(study.rows[row]);
    if (!value) return {};
    values.push_back(*value);
  }
  return values;
}

MetricValue mean_value(const StudyResult& study, std::span<const std::size_t> rows,
                       std::size_t metric) {
  MetricValue value;
  const auto measured = values_of_rows(
      study, rows, [&](const RunResult& row) { return row.metrics[metric].measured; });
  const auto predicted = values_of_rows(
      study, rows, [&](const RunResult& row) { return row.metrics[metric].predicted; });
  if (!measured.empty()) value.measured = mean(measured);
  if (const auto interval = mean_interval(measured)) value.half_width = interval->half_width;
  if (!predicted.empty()) value.predicted = mean(predicted);
  for (const std::size_t row : rows)
    if (value.no_form.empty()) value.no_form = study.rows[row].metrics[metric].no_form;
  value.ok = study.rows[rows.front()].metrics[metric].ok;
  const bool agree = std::ranges::all_of(
      rows, [&](std::size_t row) { return study.rows[row].metrics[metric].ok == value.ok; });
  if (!agree) value.ok.reset();
  return value;
}

std::string mean_status(const StudyResult& study, std::span<const std::size_t> rows) {
  const auto other = [&](std::size_t row) { return study.rows[row].status != "ok"; };
  const auto first = std::ranges::find_if(rows, other);
  if (first == rows.end()) return "ok";
  return fmt::format("{} ({} of {} seeds)", study.rows[*first].status,
                     std::ranges::count_if(rows, other), rows.size());
}

Trace mean_trace(const std::vector<RecordedTrace>& traces) {
  Trace sum = traces.front().read();
  for (std::size_t i = 1; i < traces.size(); ++i) {
    const Trace trace = traces[i].read();
    if (trace.time != sum.time) return {};
    for (std::size_t k = 0; k < trace.value.size(); ++k) sum.value[k] += trace.value[k];
  }
  for (double& value : sum.value) value /= static_cast<double>(traces.size());
  return sum;
}

}  // namespace

RunResult mean_of_rows(const StudyResult& study, std::span<const std::size_t> rows) {
  const RunResult& first = study.rows[rows.front()];
  RunResult merged;
  merged.parameters = first.parameters;
  merged.subject = first.subject;
  merged.composition = first.composition;
  merged.regime = first.regime;
  for (const std::size_t row : rows)
    if (study.rows[row].regime != first.regime) merged.regime = Regime::none;
  for (std::size_t metric = 0; metric < first.metrics.size(); ++metric)
    merged.metrics.push_back(mean_value(study, rows, metric));
  merged.status = mean_status(study, rows);
  for (std::size_t plot = 0; plot < first.traces.size(); ++plot) {
    std::vector<RecordedTrace> traces;
    for (const std::size_t row : rows) traces.push_back(study.rows[row].traces[plot]);
    merged.traces.emplace_back([traces = std::move(traces)] { return mean_trace(traces); });
  }
  return merged;
}

StudyResult over_seeds(const StudyResult& study) {
  if (!study.seed_sweep) return study;
  const auto seeds = static_cast<std::ptrdiff_t>(*study.seed_sweep);
  StudyResult means = study;
  means.runs = &study;
  means.seed_sweep.reset();
  means.sweeps.erase(means.sweeps.begin() + seeds);
  means.rows.clear();
  // In the order of their first rows.
  std::map<std::pair<int, std::vector<double>>, std::size_t> places;
  std::vector<std::vector<std::size_t>> groups;
  std::vector<int> group_of_row;
  for (std::size_t row = 0; row < study.rows.size(); ++row) {
    std::vector<double> parameters = study.rows[row].parameters;
    parameters.erase(parameters.begin() + seeds);
    const auto [place, fresh] = places.try_emplace(
        std::make_pair(study.rows[row].subject, std::move(parameters)), groups.size());
    if (fresh) groups.emplace_back();
    groups[place->second].push_back(row);
    group_of_row.push_back(static_cast<int>(place->second));
  }
  for (const std::vector<std::size_t>& group : groups) {
    RunResult& merged = means.rows.emplace_back(mean_of_rows(study, group));
    merged.parameters.erase(merged.parameters.begin() + seeds);
  }
  for (TruthResult& truth : means.truths)
    if (truth.first_failure >= 0)
      truth.first_failure = group_of_row[static_cast<std::size_t>(truth.first_failure)];
  return means;
}

std::string seeds_words(const StudyResult& means) {
  const std::size_t seeds = means.runs->sweeps[*means.runs->seed_sweep].values.size();
  return fmt::format(
      "each run is the mean of {0}, of seeds 1 to {0}; ± is half its 95 % interval (Student's t)",
      seeds);
}

}  // namespace hookpoint::studies
