// What both methods of a calibration need of one subject: cases, points, records, streams of random
// numbers.
#pragma once

#include <cstddef>
#include <cstdint>
#include <optional>
#include <random>
#include <string>
#include <vector>

#include "studies/calibrate/calibration.h"
#include "studies/calibrate/fits.h"
#include "studies/calibrate/model.h"

namespace hookpoint::studies {

/// Indices into CalibrationPlan::cases, in order.
using Cases = std::vector<std::size_t>;

/// Points along each constant's axis at which other valleys are searched for.
inline constexpr std::size_t axis_points = 12;
/// Streams of random numbers; those of the bootstrap's samples come before.
inline constexpr std::size_t streams_of_draws = 1'000'000, streams_of_surfaces = 2'000'000,
                             streams_of_predictions = 3'000'000;

/// Cases that each fold holds out, and those that it is fitted to.
struct Folds {
  std::vector<Cases> held, training;
};

/// Folds of a plan; 0: no cross-validation.
std::size_t fold_count(const CalibrationPlan& plan);

/// Outcome of a point at which a run cannot be made or breaks off.
FitOutcome outcome_without_value(const std::string& why);

/// Points all over the range of each constant, the others as they are.
std::vector<UnitPoint> points_on_axes(const UnitPoint& optimum);

/// Throws CalibrationInterrupted where a fit is missing.
void stop_if_unfinished(const std::vector<std::optional<FitOutcome>>& outcomes);

/// One subject in the course of its calibration.
class SubjectFit {
 public:
  SubjectFit(const CalibrationPlan& all, const CalibrationSubject& one, const EngineTable& engines,
             CachedRuns& cached, const std::atomic<bool>& stop);
  SubjectFit(const SubjectFit&) = delete;
  SubjectFit& operator=(const SubjectFit&) = delete;

  const CalibrationPlan& plan;
  CalibrationSubject subject;  ///< with the constants that it reads
  CachedRuns& runs;
  CalibrationModel model;
  Cases cases;  ///< all of the plan
  SubjectCalibration result;

  std::vector<std::optional<FitOutcome>> run(const FitBatch& fits) { return run_fits(runs, fits); }
  /// Residuals of these cases, case after case; those of a run that breaks off are not numbers.
  Residuals predict(const UnitPoint& point, const Cases& cases) const;

  /// The scene's own constants; the middle of the range where it has none.
  UnitPoint own_or_middle() const;
  /// The scene's own constants and the analytic guess.
  std::vector<UnitPoint> first_guesses() const;
  /// Takes a point for the best so far, its intervals not known.
  void adopt(const UnitPoint& point);
  UnitPoint best_point() const;

  /// Each number draws from a stream of its own: whichever thread comes first.
  std::mt19937_64 random_of(std::size_t number) const;
  /// `most` of these at most, in their order; drawn from a stream of its own.
  Cases drawn_from(Cases cases, std::size_t stream, std::size_t most) const;
  /// Cases that a search evaluates: of all cases number 0, or the fold's.
  Cases drawn_cases(const Cases& cases, std::size_t number) const;
  Cases drawn_cases() const { return drawn_cases(cases, 0); }
  /// `never_held`: cases that all folds may see, in order.
  Folds folds_of_cases(const Cases& never_held) const;

  /// Hash of what decides the numbers of a fit.
  std::string identity(const char* stage, std::size_t number, const UnitPoint& from) const;
};

}  // namespace hookpoint::studies
