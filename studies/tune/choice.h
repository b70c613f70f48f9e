// What comes out of the candidates of a tuning: the Pareto set, the one that is recommended, and
// how much better it is than another beyond the noise of seeds.
#pragma once

#include <cstddef>
#include <optional>
#include <span>
#include <string>
#include <vector>

#include "studies/tune/candidates.h"

namespace hookpoint::studies {

/// Whether the candidate meets all requirements, with every seed.
bool is_feasible(const TunePlan& plan, const Candidate& candidate);

/// The feasible ones that no other dominates (is as good in every objective and better in one), by
/// the first objective, then by number. Fresh seeds, one at a time and Sobol's do not count. Of
/// equals the first.
std::vector<std::size_t> pareto_set(const TunePlan& plan, const std::vector<Candidate>& candidates);

struct Recommendation {
  std::size_t candidate = 0;
  bool feasible = true;
  std::string reason;
};

/// Of the Pareto set, the members that are no worse in any objective than any of the `references`
/// that meets all requirements, or all of it where there are none such; of these the nearest to the
/// ideal point, with every objective scaled to 0..1 over the Pareto set. Where nothing is feasible,
/// what misses least. Nothing without candidates.
std::optional<Recommendation> recommend(const TunePlan& plan,
                                        const std::vector<Candidate>& candidates,
                                        const std::vector<std::size_t>& pareto,
                                        std::span<const std::size_t> references);

/// A candidate's objective beside another's, both with the same seeds.
struct ObjectiveComparison {
  enum class Verdict { better, worse, within_noise, undecided };
  std::optional<double> tuned, other;  ///< what the objective makes of the seeds
  double difference = 0.;              ///< tuned less other: mean over the seeds
  double margin = 0.;  ///< half of the 95 % interval of that mean: Student's t, paired by seeds
  Verdict verdict = Verdict::undecided;
};

/// One an objective. Better and worse are beyond the margin; with a single seed, or without values
/// of the tuned one, nothing is decided; better than one without values.
std::vector<ObjectiveComparison> compare_candidates(const TunePlan& plan, const Candidate& tuned,
                                                    const Candidate& other);

}  // namespace hookpoint::studies
