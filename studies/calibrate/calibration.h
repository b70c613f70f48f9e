// Fits the constants of every subject to what was measured, by the same method and with the same
// budget. Its files are outputs.h's.
#pragma once

#include <atomic>
#include <cstddef>
#include <filesystem>
#include <functional>
#include <memory>
#include <optional>
#include <string>
#include <string_view>
#include <vector>

#include "output/files/result_folder.h"
#include "studies/calibrate/problem.h"
#include "studies/run/provenance.h"
#include "studies/run/run.h"

namespace hookpoint::studies {

/// What a row of evaluations.csv is of.
enum class FitStage { start, refined, axis, search, profile, resample, fold };
std::string_view name_of(FitStage stage);

/// "lower" or "upper" where a share stands at that end of its range, else "".
std::string_view range_end(double share);

/// A point of a subject's box that was fitted or evaluated.
struct FitRecord {
  FitStage stage = FitStage::start;
  std::size_t number = 0;  ///< within its stage
  UnitPoint point;         ///< of the subject's constants; empty where there is none
  std::optional<double> error;
  std::size_t models = 0;  ///< points at which all cases were run for it
  std::string status = "ok";
};

/// What is known of a constant that was fitted.
struct FittedConstant {
  std::size_t constant = 0;  ///< index into CalibrationPlan::varied
  double share = 0.;
  /// Of 95 %; nothing while it is not known.
  std::optional<double> low, high;  ///< shares
  bool identifiable = false;        ///< by the data
  std::string reason;               ///< why not, or what is missing
};

/// A fit whose error is so many times what is expected, where each weight is 1 over the noise,
/// misses its own weights.
constexpr double greatest_error_of_a_fit = 2.;

/// Where the error of cases that a fit has not seen will be, with a chance of 95 %.
struct PredictionInterval {
  double error = 0., low = 0., high = 0.;
};

/// Errors as CalibrationPlan::method has them.
struct FoldResult {
  std::vector<std::size_t> held_out;  ///< cases
  std::optional<double> training, held;
  UnitPoint point;
  /// Of cmaes, by cases that the fold may see and that its search did not evaluate.
  std::optional<PredictionInterval> prediction{};
};

struct SubjectCalibration {
  std::vector<FitRecord> records;
  std::vector<LeftOut> left_out;          ///< those of the plan, and what changes no trace
  std::vector<FittedConstant> constants;  ///< those that were fitted
  std::optional<double> own_error;        ///< with the scene's own constants
  /// At the optimum: the root mean square of the weighted residuals, or of cmaes the mean over the
  /// cases that the search looked at of their mean weighted distance.
  std::optional<double> error;
  std::vector<std::vector<double>> correlations;  ///< of the constants; empty: not known
  std::size_t resamples = 0;                      ///< that have a fit
  std::size_t block = 0;                          ///< samples drawn together; 0: cases
  std::vector<FoldResult> folds;
  /// At the optimum, of cmaes with folds each case by the constants that were fitted without it;
  /// case after case, those of a run that broke off not numbers; empty: none.
  Residuals residuals;
  Residuals own_residuals;    ///< with the scene's own constants
  std::string status = "ok";  ///< or why it has no fit
};

struct CalibrationResult {
  std::vector<SubjectCalibration> subjects;  ///< those of the plan, as far as it came
  bool interrupted = false;
};

/// Messages while it runs.
struct CalibrationOptions {
  RunOptions run;
  std::function<void(const std::string& message)> tell{};
};

struct CalibrationRun {
  CalibrationResult result;
  Provenance provenance;
  std::filesystem::path folder;
  std::unique_ptr<output::ResultFolder> files;  ///< locks the folder
};

/// Of cmaes: whether folds search all over the box, as the first search does. It is so where that
/// evaluates more than half of the cases; else they begin where it ended, and none holds out what
/// it has evaluated.
bool folds_search_whole_box(const CalibrationPlan& plan);

/// Root mean square; nothing of none.
std::optional<double> error_of(const Residuals& residuals);

/// Runs until all is known or `stop` is set; then the result is what was known. Finished fits are
/// in the folder's store. The same plan gives the same result for any number of threads,
/// interrupted and resumed or not. Throws as run_study does.
CalibrationRun run_calibration(const CalibrationPlan& plan, const EngineTable& engines,
                               const CalibrationOptions& options, const std::atomic<bool>& stop);

}  // namespace hookpoint::studies
