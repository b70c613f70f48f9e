#include "studies/tune/candidates.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <map>

#include "output/files/hash.h"
#include "studies/results/statistics.h"

namespace hookpoint::studies {
namespace {

/// A run without a value misses more than any with one.
constexpr double without_value = 1e6;
/// The score of a candidate in an objective of which it may lack the value, worse than any value.
constexpr double worst_score = 1e100;

/// The candidate before its runs.
Candidate candidate_of(const TunePlan& plan, const Candidates::Wanted& wanted) {
  Candidate candidate{wanted.stage, wanted.generation, {}, wanted.first_seed, {}, {}};
  if (wanted.values.empty())
    candidate.values = plan.own;
  else
    candidate.values.assign(wanted.values.begin(), wanted.values.end());
  return candidate;
}

void add_run(const TunePlan& plan, const RunRecord& record, Candidate& candidate) {
  candidate.statuses.push_back(record.status);
  auto& measured = candidate.measured.emplace_back();
  for (const MetricDefinition* metric : plan.runs.metric_definitions())
    measured.push_back(record.values.at(kept_name(*metric)).measured);
}

/// Of a run whose scene cannot be loaded: every metric is there, without a value.
RunRecord unloadable(const Measurement& measurement, const language::Diagnostics& found) {
  RunRecord record;
  record.status = "cannot run: " + found.first_error();
  for (const MetricDefinition* metric : measurement.metrics) record.values[kept_name(*metric)] = {};
  return record;
}

/// Whether a seed's run lacks the value of a metric. A run that came to its end may lack one that
/// may be empty.
bool lacks(const Candidate& candidate, std::size_t seed, std::size_t metric, bool may_be_empty) {
  return !candidate.measured[seed][metric] && !(may_be_empty && candidate.statuses[seed] == "ok");
}

/// The part of the seeds that lack the value of the metric.
double missing_part(const Candidate& candidate, std::size_t metric, bool may_be_empty) {
  double missing = 0.;
  for (std::size_t seed = 0; seed < candidate.measured.size(); ++seed)
    missing += lacks(candidate, seed, metric, may_be_empty) ? 1. : 0.;
  return missing / static_cast<double>(candidate.seeds());
}

}  // namespace

std::string_view name_of(CandidateStage stage) {
  switch (stage) {
    case CandidateStage::own:
      return "own";
    case CandidateStage::analytic:
      return "analytic";
    case CandidateStage::search:
      return "search";
    case CandidateStage::fresh_seeds:
      return "fresh_seeds";
    case CandidateStage::one_at_a_time:
      return "one_at_a_time";
    case CandidateStage::sobol:
      return "sobol";
  }
  return "search";
}

std::optional<std::vector<double>> values_of_seeds(const Candidate& candidate, std::size_t metric) {
  std::vector<double> values;
  for (const auto& measured : candidate.measured) {
    if (!measured[metric]) return std::nullopt;
    values.push_back(*measured[metric]);
  }
  return values;
}

double take_of(const ObjectivePlan& objective, std::span<const double> values) {
  if (objective.take == ObjectivePlan::Take::mean) return mean(values);
  const auto [least, greatest] = std::ranges::minmax(values);
  return objective.maximise ? least : greatest;
}

std::optional<std::vector<double>> objective_of_seeds(const ObjectivePlan& objective,
                                                      const Candidate& candidate) {
  auto values = values_of_seeds(candidate, objective.metric);
  if (values)
    for (double& value : *values) value = objective.of_run(value);
  return values;
}

std::optional<double> value_of(const ObjectivePlan& objective, const Candidate& candidate) {
  const auto values = objective_of_seeds(objective, candidate);
  return values ? std::optional(take_of(objective, *values)) : std::nullopt;
}

bool meets(const Candidate& candidate, const RequirementPlan& required) {
  for (std::size_t seed = 0; seed < candidate.measured.size(); ++seed) {
    const auto& value = candidate.measured[seed][required.metric];
    if (lacks(candidate, seed, required.metric, required.may_be_empty)) return false;
    if (value && required.missed_by(*value) > 0.) return false;
  }
  return true;
}

double violation_of(const TunePlan& plan, const Candidate& candidate) {
  double violation = 0.;
  std::map<std::size_t, bool> needed;  // metrics, and whether they may be empty
  const auto need = [&needed](std::size_t metric, bool may_be_empty) {
    bool& may = needed.try_emplace(metric, true).first->second;
    may = may && may_be_empty;
  };
  for (const ObjectivePlan& objective : plan.objectives)
    need(objective.metric, objective.may_be_empty);
  for (const RequirementPlan& required : plan.requirements) {
    need(required.metric, required.may_be_empty);
    double most = 0.;
    for (const auto& measured : candidate.measured)
      if (measured[required.metric])
        most = std::max(most, required.missed_by(*measured[required.metric]));
    violation += most;
  }
  for (const auto& [metric, may_be_empty] : needed)
    violation += without_value * missing_part(candidate, metric, may_be_empty);
  return violation;
}

Score score_of(const TunePlan& plan, const Candidate& candidate) {
  Score score;
  score.violation = violation_of(plan, candidate);
  for (const ObjectivePlan& objective : plan.objectives) {
    const auto value = value_of(objective, candidate);
    const double lacking = objective.may_be_empty ? worst_score : 0.;
    score.objectives.push_back(!value ? lacking : objective.maximise ? -*value : *value);
  }
  return score;
}

std::string Candidates::identity_of(const SeedRun& run) const {
  output::Hash identity;
  identity.add(plan_.runs_hash).add(std::to_string(run.seed));
  for (const ConstantSetting& constant : run.constants)
    identity.add(constant.name).add(constant.text);
  return identity.text();
}

std::optional<RunRecord> Candidates::make(const SeedRun& run) const {
  if (stop_.load(std::memory_order_relaxed)) return std::nullopt;
  const Measurement measurement = plan_.measurement();
  language::Diagnostics found;
  auto scene = plan_.scene->load(run.constants, run.seed, found);
  if (!scene) return unloadable(measurement, found);
  scene->experiment.duration = measurement.duration;
  return execute(measurement, scene->experiment, engines_, "", stop_);
}

std::optional<RunRequest> Candidates::request_of(const SeedRun& run) const {
  const Measurement measurement = plan_.measurement();
  language::Diagnostics unreported;
  const auto scene = plan_.scene->load(run.constants, run.seed, unreported);
  if (!scene) return std::nullopt;
  return RunRequest{fmt::format("{}, seed {}", plan_.runs.name, run.seed),
                    run_identity(scene->hash(), measurement, scene->experiment.engine, engines_),
                    plan_.scene->under(run.constants, run.seed), measurement};
}

std::vector<std::size_t> Candidates::evaluate(const std::vector<Wanted>& wanted) {
  std::vector<std::size_t> indices;
  std::vector<std::size_t> fresh;  // of `wanted`
  std::vector<SeedRun> runs;
  const std::size_t first = all_.size();
  for (std::size_t i = 0; i < wanted.size(); ++i) {
    const Wanted& asked = wanted[i];
    const std::size_t next = first + fresh.size();
    // The files' own constants may have more digits than are written: they are known by none.
    const auto [entry, is_new] = known_.try_emplace(Key{asked.values, asked.first_seed}, next);
    indices.push_back(entry->second);
    if (!is_new) {
      runs_.skip(static_cast<std::size_t>(asked.seeds));
      continue;
    }
    fresh.push_back(i);
    for (int seed = 0; seed < asked.seeds; ++seed)
      runs.push_back(
          {plan_.settings(asked.values), asked.first_seed + static_cast<std::uint64_t>(seed)});
  }
  RunBatch batch;
  batch.count = runs.size();
  batch.identity = [&](std::size_t run) { return identity_of(runs[run]); };
  batch.make = [&](std::size_t run) { return make(runs[run]); };
  batch.complete = [measurement = plan_.measurement()](std::size_t, const RunRecord& record) {
    return measurement.found_in(record);
  };
  // A request is asked for several times, and costs as much as loading the scene.
  std::vector<std::optional<std::optional<RunRequest>>> requests(runs.size());
  batch.request = [&](std::size_t run) {
    if (!requests[run]) requests[run] = request_of(runs[run]);
    return *requests[run];
  };
  const auto records = runs_.records(batch);
  auto record = records.begin();
  for (const std::size_t i : fresh) {
    const auto end = record + wanted[i].seeds;
    if (std::all_of(record, end, [](const auto& made) { return made.has_value(); })) {
      Candidate& candidate = all_.emplace_back(candidate_of(plan_, wanted[i]));
      for (auto made = record; made != end; ++made) add_run(plan_, **made, candidate);
    }
    record = end;
  }
  if (all_.size() < first + fresh.size()) throw TuneInterrupted{};
  return indices;
}

}  // namespace hookpoint::studies
