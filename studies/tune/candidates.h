// The candidates of a tuning: their values, what their runs measured, and how good that is.
#pragma once

#include <cstddef>
#include <cstdint>
#include <map>
#include <optional>
#include <span>
#include <string>
#include <string_view>
#include <utility>
#include <vector>

#include "studies/tune/problem.h"
#include "studies/tune/run_batches.h"

namespace hookpoint::studies {

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

double mean_of(std::span<const double> values);
/// Standard error of the mean; 0 of a single value.
double standard_error_of(std::span<const double> values);

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
  Candidates(const TunePlan& plan, RunBatches& batches) : plan_(plan), batches_(batches) {}

  /// What is to be evaluated.
  struct Wanted {
    CandidateStage stage = CandidateStage::search;
    int generation = 0;
    std::vector<double> values;  ///< none: the files' own
    std::uint64_t first_seed = 1;
    int seeds = 1;
  };
  /// Indices of the candidates; one that is known with these seeds is not run again. When that is
  /// interrupted, those whose runs are all finished are kept.
  std::vector<std::size_t> evaluate(const std::vector<Wanted>& wanted);

  const std::vector<Candidate>& all() const { return all_; }
  const Candidate& operator[](std::size_t index) const { return all_[index]; }

 private:
  using Key = std::pair<std::vector<double>, std::uint64_t>;

  const TunePlan& plan_;
  RunBatches& batches_;
  std::vector<Candidate> all_;
  std::map<Key, std::size_t> known_;
};

}  // namespace hookpoint::studies
