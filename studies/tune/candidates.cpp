#include "studies/tune/candidates.h"

#include <algorithm>
#include <cmath>
#include <set>

namespace hookpoint::studies {
namespace {

/// A run without a value misses more than any with one.
constexpr double without_value = 1e6;

/// The candidate as its runs left it.
Candidate finished_candidate(const TunePlan& plan, const Candidates::Wanted& wanted,
                             std::span<const WantedOutcome> outcomes) {
  Candidate candidate{wanted.stage, wanted.generation, {}, wanted.first_seed, {}, {}};
  if (wanted.values.empty())
    candidate.values = plan.own;
  else
    candidate.values.assign(wanted.values.begin(), wanted.values.end());
  for (const WantedOutcome& outcome : outcomes) {
    candidate.statuses.push_back(outcome.status);
    candidate.measured.push_back(outcome.measured);
  }
  return candidate;
}

/// The part of the seeds that have no value of the metric.
double missing_part(const Candidate& candidate, std::size_t metric) {
  double missing = 0.;
  for (const auto& measured : candidate.measured) missing += measured[metric] ? 0. : 1.;
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

double mean_of(std::span<const double> values) {
  double sum = 0.;
  for (const double value : values) sum += value;
  return sum / static_cast<double>(values.size());
}

double standard_error_of(std::span<const double> values) {
  const auto count = static_cast<double>(values.size());
  if (values.size() < 2) return 0.;
  const double mean = mean_of(values);
  double squares = 0.;
  for (const double value : values) squares += (value - mean) * (value - mean);
  return std::sqrt(squares / (count - 1.) / count);
}

double take_of(const ObjectivePlan& objective, std::span<const double> values) {
  if (objective.take == ObjectivePlan::Take::mean) return mean_of(values);
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
  return std::ranges::all_of(candidate.measured, [&](const auto& measured) {
    const auto& value = measured[required.metric];
    return value && !(required.missed_by(*value) > 0.);
  });
}

double violation_of(const TunePlan& plan, const Candidate& candidate) {
  double violation = 0.;
  std::set<std::size_t> needed;
  for (const ObjectivePlan& objective : plan.objectives) needed.insert(objective.metric);
  for (const RequirementPlan& required : plan.requirements) {
    needed.insert(required.metric);
    double most = 0.;
    for (const auto& measured : candidate.measured)
      if (measured[required.metric])
        most = std::max(most, required.missed_by(*measured[required.metric]));
    violation += most;
  }
  for (const std::size_t metric : needed)
    violation += without_value * missing_part(candidate, metric);
  return violation;
}

Score score_of(const TunePlan& plan, const Candidate& candidate) {
  Score score;
  score.violation = violation_of(plan, candidate);
  for (const ObjectivePlan& objective : plan.objectives) {
    const double value = value_of(objective, candidate).value_or(0.);
    score.objectives.push_back(objective.maximise ? -value : value);
  }
  return score;
}

std::vector<std::size_t> Candidates::evaluate(const std::vector<Wanted>& wanted) {
  std::vector<std::size_t> indices;
  std::vector<std::size_t> fresh;  // of `wanted`
  std::vector<WantedRun> requests;
  const std::size_t first = all_.size();
  for (std::size_t i = 0; i < wanted.size(); ++i) {
    const Wanted& asked = wanted[i];
    const std::size_t next = first + fresh.size();
    // The files' own constants may have more digits than are written: they are known by none.
    const auto [entry, is_new] = known_.try_emplace(Key{asked.values, asked.first_seed}, next);
    indices.push_back(entry->second);
    if (!is_new) {
      batches_.skip(static_cast<std::size_t>(asked.seeds));
      continue;
    }
    fresh.push_back(i);
    for (int seed = 0; seed < asked.seeds; ++seed)
      requests.push_back(
          {plan_.settings(asked.values), asked.first_seed + static_cast<std::uint64_t>(seed)});
  }
  const auto take = [&](const std::vector<std::optional<WantedOutcome>>& outcomes) {
    std::size_t at = 0;
    for (const std::size_t i : fresh) {
      std::vector<WantedOutcome> runs;
      for (int seed = 0; seed < wanted[i].seeds; ++seed, ++at)
        if (outcomes[at]) runs.push_back(*outcomes[at]);
      if (runs.size() == static_cast<std::size_t>(wanted[i].seeds))
        all_.push_back(finished_candidate(plan_, wanted[i], runs));
    }
  };
  try {
    const std::vector<WantedOutcome> outcomes = batches_.run(requests);
    take({outcomes.begin(), outcomes.end()});
  } catch (const BatchInterrupted& interrupted) {
    take(interrupted.finished);
    throw;
  }
  return indices;
}

}  // namespace hookpoint::studies
