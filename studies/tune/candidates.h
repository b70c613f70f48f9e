// The candidates of a tuning: their values, what their runs measured, and how good that is.
#pragma once

#include <atomic>
#include <cstddef>
#include <cstdint>
#include <map>
#include <optional>
#include <span>
#include <string>
#include <string_view>
#include <utility>
#include <vector>

#include "studies/run/runs.h"
#include "studies/tune/problem.h"

namespace hookpoint::studies {

/// `stop` was set.
struct TuneInterrupted {};

/// Why a candidate was evaluated.
enum class CandidateStage { own, analytic, search, fresh_seeds, one_at_a_time, sobol };
std::string_view name_of(CandidateStage stage);

struct Candidate {
  CandidateStage stage = CandidateStage::search;
  int generation = 0;  ///< of the search, from 1; 0 elsewhere
  /// One a constant, in its unit; nothing where the files' own constants say none.
  std::vector<std::optional<double>> values;
  std::uint64_t first_seed = 1;       ///< of its runs, which follow one another
  std::vector<std::string> statuses;  ///< one a seed
  std::vector<std::vector<std::optional<double>>> measured;  ///< a seed's metrics

  std::size_t seeds() const { return measured.size(); }
};

/// A metric's values over seeds; nothing unless every seed has one.
std::optional<std::vector<double>> values_of_seeds(const Candidate& candidate, std::size_t metric);

/// What an objective makes of the seeds' values.
double take_of(const ObjectivePlan& objective, std::span<const double> values);
/// The objective of each seed's run; nothing where one has no value.
std::optional<std::vector<double>> objective_of_seeds(const ObjectivePlan& objective,
                                                      const Candidate& candidate);
std::optional<double> value_of(const ObjectivePlan& objective, const Candidate& candidate);

/// Whether every seed has a value that the requirement allows.
bool meets(const Candidate& candidate, const RequirementPlan& required);

/// How far the candidate is from the requirements: the sum over them of the seed that misses most,
/// and a million for each part of the seeds of which an objective or a requirement has no value.
double violation_of(const TunePlan& plan, const Candidate& candidate);

/// Objectives to be minimised.
Score score_of(const TunePlan& plan, const Candidate& candidate);

/// All that were evaluated, in order.
class Candidates {
 public:
  /// All outlives it.
  Candidates(const TunePlan& plan, const EngineTable& engines, CachedRuns& runs,
             const std::atomic<bool>& stop)
      : plan_(plan), engines_(engines), runs_(runs), stop_(stop) {}

  /// What is to be evaluated.
  struct Wanted {
    CandidateStage stage = CandidateStage::search;
    int generation = 0;
    std::vector<double> values;  ///< none: the files' own
    std::uint64_t first_seed = 1;
    int seeds = 1;
  };
  /// Indices of the candidates, whatever the number of threads; one that is known with these seeds
  /// is not run again. A scene that cannot be loaded so is a run with that status. When interrupted,
  /// keeps those whose runs are all finished and throws TuneInterrupted. Throws StoreError.
  std::vector<std::size_t> evaluate(const std::vector<Wanted>& wanted);

  const std::vector<Candidate>& all() const { return all_; }
  const Candidate& operator[](std::size_t index) const { return all_[index]; }

 private:
  using Key = std::pair<std::vector<double>, std::uint64_t>;

  /// One run of a candidate.
  struct SeedRun {
    std::vector<ConstantSetting> constants;
    std::uint64_t seed = 1;
  };
  std::string identity_of(const SeedRun& run) const;
  std::optional<RunRecord> make(const SeedRun& run) const;
  /// For another process; nothing where its scene cannot be loaded.
  std::optional<RunRequest> request_of(const SeedRun& run) const;

  const TunePlan& plan_;
  const EngineTable& engines_;
  CachedRuns& runs_;
  const std::atomic<bool>& stop_;
  std::vector<Candidate> all_;
  std::map<Key, std::size_t> known_;
};

}  // namespace hookpoint::studies
