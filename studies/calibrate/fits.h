// Fits of a calibration, each a cached run whose record holds what the fit has found.
#pragma once

#include <cstddef>
#include <functional>
#include <optional>
#include <string>
#include <vector>

#include "studies/calibrate/least_squares.h"
#include "studies/run/runs.h"

namespace hookpoint::studies {

/// What a fit leaves, or the evaluation of a point.
struct FitOutcome {
  std::string status = "ok";
  std::optional<double> error;       ///< root mean square of the residuals; nothing: no run
  std::optional<double> held_out;    ///< the same of what a fold has held out
  std::size_t models = 0;            ///< points at which the cases were run
  UnitPoint point;                   ///< where it ended; empty: nowhere
  std::vector<double> cases{};       ///< error of each case; empty: not distinguished
  std::optional<double> end{};       ///< of a profile: the share at which the interval ends
  std::optional<double> wide_end{};  ///< the same of the interval of 99.9 %
  UnitPoint apart{};                 ///< of a profile: see ProfileEnd; empty: none
};

/// Some fits of one kind.
struct FitBatch {
  std::size_t count = 0;
  /// What decides the numbers of each, as a hash.
  std::function<std::string(std::size_t number)> identity;
  /// From any thread. May throw CalibrationInterrupted.
  std::function<FitOutcome(std::size_t number)> work;
};

/// Those that `runs` has from before are not made again. The outcomes in order, whatever the number
/// of threads; when interrupted nothing in the places of those that are not finished. Throws
/// StoreError.
std::vector<std::optional<FitOutcome>> run_fits(CachedRuns& runs, const FitBatch& fits);

}  // namespace hookpoint::studies
