#include "studies/tune/choice.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <limits>

#include "studies/results/statistics.h"

namespace hookpoint::studies {
namespace {

using Scores = std::vector<double>;

bool no_worse(const Scores& one, const Scores& other) {
  for (std::size_t i = 0; i < one.size(); ++i)
    if (one[i] > other[i]) return false;
  return true;
}

bool is_contender(const Candidate& candidate) {
  return candidate.stage == CandidateStage::own || candidate.stage == CandidateStage::analytic ||
         candidate.stage == CandidateStage::search;
}

Recommendation least_missing(const TunePlan& plan, const std::vector<Candidate>& candidates) {
  Recommendation found{0, false, ""};
  double least = std::numeric_limits<double>::infinity();
  for (std::size_t i = 0; i < candidates.size(); ++i) {
    const double violation = violation_of(plan, candidates[i]);
    if (!is_contender(candidates[i]) || !(violation < least)) continue;
    least = violation;
    found.candidate = i;
  }
  found.reason = "no candidate meets the requirements with every seed: this one misses least";
  return found;
}

/// Squared distance from the ideal point, objectives scaled over the Pareto set.
class KneeDistance {
 public:
  KneeDistance(const std::vector<Scores>& front) : ideal_(front.front()), nadir_(front.front()) {
    for (const Scores& scores : front) {
      for (std::size_t i = 0; i < scores.size(); ++i) {
        ideal_[i] = std::min(ideal_[i], scores[i]);
        nadir_[i] = std::max(nadir_[i], scores[i]);
      }
    }
  }
  double operator()(const Scores& scores) const {
    double sum = 0.;
    for (std::size_t i = 0; i < scores.size(); ++i) {
      const double range = nadir_[i] - ideal_[i];
      const double part = range > 0. ? (scores[i] - ideal_[i]) / range : 0.;
      sum += part * part;
    }
    return sum;
  }

 private:
  Scores ideal_, nadir_;
};

}  // namespace

bool is_feasible(const TunePlan& plan, const Candidate& candidate) {
  return !(violation_of(plan, candidate) > 0.);
}

std::vector<std::size_t> pareto_set(const TunePlan& plan,
                                    const std::vector<Candidate>& candidates) {
  std::vector<std::pair<Scores, std::size_t>> feasible;
  for (std::size_t i = 0; i < candidates.size(); ++i)
    if (is_contender(candidates[i]) && is_feasible(plan, candidates[i]))
      feasible.emplace_back(score_of(plan, candidates[i]).objectives, i);
  // Whoever dominates comes before whom it dominates.
  std::ranges::sort(feasible);
  std::vector<std::pair<Scores, std::size_t>> front;
  for (const auto& one : feasible)
    if (std::ranges::none_of(front,
                             [&](const auto& other) { return no_worse(other.first, one.first); }))
      front.push_back(one);
  std::vector<std::size_t> indices;
  for (const auto& [scores, index] : front) indices.push_back(index);
  return indices;
}

std::optional<Recommendation> recommend(const TunePlan& plan,
                                        const std::vector<Candidate>& candidates,
                                        const std::vector<std::size_t>& pareto,
                                        std::span<const std::size_t> references) {
  if (candidates.empty()) return std::nullopt;
  if (pareto.empty()) return least_missing(plan, candidates);
  std::vector<Scores> front;
  for (const std::size_t member : pareto)
    front.push_back(score_of(plan, candidates[member]).objectives);
  // What has no value, or misses a requirement, is no choice to be measured by.
  std::vector<Scores> others;
  for (const std::size_t reference : references) {
    const Candidate& other = candidates[reference];
    if (is_feasible(plan, other)) others.push_back(score_of(plan, other).objectives);
  }
  const auto beats_all = [&](const Scores& scores) {
    return std::ranges::all_of(others,
                               [&](const Scores& other) { return no_worse(scores, other); });
  };
  const auto beating = static_cast<std::size_t>(std::ranges::count_if(front, beats_all));
  const KneeDistance distance(front);
  Recommendation best{0, true, ""};
  double least = std::numeric_limits<double>::infinity();
  for (std::size_t i = 0; i < front.size(); ++i) {
    if (beating > 0 && !beats_all(front[i])) continue;
    if (!(distance(front[i]) < least)) continue;
    least = distance(front[i]);
    best.candidate = pareto[i];
  }
  if (plan.objectives.size() == 1) {
    best.reason = "the best value of the one objective";
    return best;
  }
  const std::string known = references.size() > 1
                                ? "the file's own constants and the analytic guess"
                                : "the file's own constants";
  const std::string compared =
      others.size() < references.size() ? "what of " + known + " meets all requirements" : known;
  if (others.empty())
    best.reason =
        fmt::format("{} miss a requirement; of all {} Pareto members, ", known, front.size());
  else if (beating > 0)
    best.reason =
        fmt::format("of the {} of {} Pareto members that are no worse than {} in any objective, ",
                    beating, front.size(), compared);
  else
    best.reason = fmt::format(
        "no Pareto member is as good as {} in every objective, so a trade-off: of all {}, ",
        compared, front.size());
  best.reason += "the nearest to the ideal point, objectives scaled over the Pareto set";
  return best;
}

std::vector<ObjectiveComparison> compare_candidates(const TunePlan& plan, const Candidate& tuned,
                                                    const Candidate& other) {
  using Verdict = ObjectiveComparison::Verdict;
  std::vector<ObjectiveComparison> all;
  for (const ObjectivePlan& objective : plan.objectives) {
    ObjectiveComparison& comparison = all.emplace_back();
    comparison.tuned = value_of(objective, tuned);
    comparison.other = value_of(objective, other);
    if (comparison.tuned && !comparison.other) comparison.verdict = Verdict::better;
    if (!comparison.tuned || !comparison.other || tuned.seeds() < 2) continue;
    const auto ours = objective_of_seeds(objective, tuned);
    const auto theirs = objective_of_seeds(objective, other);
    Scores differences;
    for (std::size_t i = 0; i < ours->size(); ++i) differences.push_back((*ours)[i] - (*theirs)[i]);
    comparison.difference = mean(differences);
    comparison.margin =
        student_quantile(static_cast<double>(differences.size())) * standard_error(differences);
    if (!(std::abs(comparison.difference) > comparison.margin))
      comparison.verdict = Verdict::within_noise;
    else
      comparison.verdict =
          (comparison.difference > 0.) == objective.maximise ? Verdict::better : Verdict::worse;
  }
  return all;
}

}  // namespace hookpoint::studies
