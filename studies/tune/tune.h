// Runs a tuning: first guesses, search, choice, a check on fresh seeds, sensitivities. Its files
// are outputs.h's.
#pragma once

#include <atomic>
#include <cstddef>
#include <filesystem>
#include <functional>
#include <memory>
#include <optional>
#include <string>
#include <vector>

#include "output/files/result_folder.h"
#include "studies/run/provenance.h"
#include "studies/tune/choice.h"
#include "studies/tune/sensitivity.h"

namespace hookpoint::studies {

/// What the tuned constants are held against.
struct TuneReference {
  std::string name;  ///< "the file's own constants"
  std::string key;   ///< "own"
  std::size_t candidate = 0;
  std::optional<std::size_t> fresh;  ///< the same with the fresh seeds
  std::vector<ObjectiveComparison> comparisons;
};

/// One constant varied, the others as recommended.
struct OneAtATime {
  std::vector<double> shares;  ///< of its range, from 0 to 1
  std::vector<std::size_t> candidates;
};

/// Depth of the deepest point over time with a set of constants, in the first seed's run.
struct DepthCurve {
  std::string name;
  Trace trace;
};

/// What is known of a tuning, all of it or, of one that was interrupted, the beginning.
struct TuneResult {
  std::vector<Candidate> candidates;
  std::vector<TuneReference> references;  ///< the file's own constants, the analytic guess
  std::string analytic_words;             ///< how that was come by, or why there is none
  std::vector<std::size_t> pareto;
  std::optional<Recommendation> recommended;
  std::optional<std::size_t> fresh;                  ///< the recommended with the fresh seeds
  std::vector<OneAtATime> one_at_a_time;             ///< one a constant
  std::vector<std::optional<SobolIndices>> indices;  ///< one an objective; empty: not requested
  std::vector<DepthCurve> depths;
  bool interrupted = false;

  const Candidate& best() const { return candidates[recommended->candidate]; }
  /// Whether the recommended meets the requirements, with the fresh seeds too.
  bool holds(const TunePlan& plan) const;
};

/// A generation that was scored.
struct GenerationReport {
  int generation = 0, generations = 0;
  double runs_per_second = 0.;
  std::size_t pareto = 0;         ///< candidates in the Pareto set
  std::vector<std::string> best;  ///< "foot_slip 0.021": of each objective, over feasible ones
};

struct TuneOptions {
  RunOptions run;
  std::function<void(const GenerationReport&)> generation{};
};

struct TuneRun {
  TuneResult result;
  Provenance provenance;
  std::filesystem::path folder;
  std::unique_ptr<output::ResultFolder> files;  ///< locks the folder
};

/// Seeds of the search are 1 to `seeds`; twice as many that follow check what was chosen.
inline int fresh_seeds(const TunePlan& plan) { return 2 * plan.seeds; }

/// Runs until all is known or `stop` is set; then the result is what was known. Finished runs are
/// in the folder's store. The same plan gives the same result for any number of threads,
/// interrupted and resumed or not. Throws as run_study does.
TuneRun run_tuning(const TunePlan& plan, const EngineTable& engines, const TuneOptions& options,
                   const std::atomic<bool>& stop);

}  // namespace hookpoint::studies
