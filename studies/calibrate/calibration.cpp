#include "studies/calibrate/calibration.h"

#include <fmt/format.h>

#include <array>
#include <cmath>
#include <utility>

#include "studies/calibrate/calibration_method.h"
#include "studies/calibrate/outputs.h"
#include "studies/search/step_warnings.h"
#include "text/number.h"

namespace hookpoint::studies {
namespace {

/// A constant within this part of its range from an end is at it.
constexpr double end_part = 2e-3;
/// Normalised values at which a constant is tried for whether it changes anything: not symmetrical,
/// since a function of it may be even, and near both ends, since one may be flat between.
constexpr std::array read_at{0.25, 0.75, 0.37, 0.02, 0.98};
/// And those of the others, where it changes nothing beside the scene's own: one may decide whether
/// another acts.
constexpr double others_low = 0.02, others_high = 0.98;
/// Status of a constant with which every run is the same, bit for bit.
constexpr const char* unread = "no trace changes with it";

const MethodDefinition& method_of(const CalibrationPlan& plan) {
  return plan.method == FitMethod::cmaes ? fit_by_distance : fit_by_squares;
}

/// Rows of the store that a subject requests at most.
std::size_t rows_of(const CalibrationPlan& plan, const CalibrationSubject& subject) {
  return subject.refusal.empty() ? method_of(plan).rows(plan, subject.constants.size()) : 0;
}

/// Order of one subject's calibration, stage by stage; each needs those before it.
class SubjectStages {
 public:
  SubjectStages(const CalibrationPlan& plan, const CalibrationSubject& subject,
                const EngineTable& engines, CachedRuns& runs, const std::atomic<bool>& stop)
      : fit_(plan, subject, engines, runs, stop), method_(method_of(plan).make(fit_)) {}

  /// False when interrupted; then the result is what was known.
  bool run() {
    const std::size_t first = fit_.runs.count(), total = rows_of(fit_.plan, fit_.subject);
    bool whole = true;
    try {
      run_stages();
    } catch (const CalibrationInterrupted&) {
      whole = false;
      if (fit_.result.status == "ok") fit_.result.status = "interrupted";
    }
    if (whole) fit_.runs.skip(total - (fit_.runs.count() - first));
    return whole;
  }
  SubjectCalibration take() { return std::move(fit_.result); }

 private:
  void run_stages() {
    if (!fit_.subject.refusal.empty()) {
      fit_.result.status = fit_.subject.refusal;
      return;
    }
    evaluate_own_constants();
    if (!fit_.plan.varied.empty()) leave_out_unread();
    if (fit_.subject.constants.empty()) {
      if (!fit_.plan.varied.empty()) fit_.result.status = "none of the constants changes a trace";
      fit_.result.error = fit_.result.own_error;
      fit_.result.residuals = fit_.result.own_residuals;
      return;
    }
    if (!method_->search()) return;
    method_->intervals();
    method_->folds();
  }

  void evaluate_own_constants() {
    Residuals residuals = fit_.predict({}, fit_.cases);
    fit_.result.own_error = method_->error_over(fit_.cases, residuals);
    if (fit_.result.own_error) fit_.result.own_residuals = std::move(residuals);
  }

  /// Whether the residuals change with a constant, or there are none; `models` counts.
  bool changes_with(std::size_t constant, UnitPoint point, const Cases& cases,
                    std::size_t& models) const {
    std::optional<Residuals> first;
    for (const double share : read_at) {
      point[constant] = share;
      auto found = fit_.model.residuals(point, cases);
      ++models;
      if (!found || (first && *found != *first)) return true;
      first = std::move(found);
    }
    return false;
  }

  void leave_out_unread() {
    const UnitPoint middle = fit_.own_or_middle();
    const Cases cases = fit_.drawn_cases();
    const auto outcomes =
        fit_.run({middle.size(), [&](std::size_t i) { return fit_.identity("reads", i, middle); },
                  [&](std::size_t i) {
                    FitOutcome outcome{unread, std::nullopt, std::nullopt, 0, UnitPoint{}, {}};
                    for (const UnitPoint& others : {middle, UnitPoint(middle.size(), others_low),
                                                    UnitPoint(middle.size(), others_high)}) {
                      if (!changes_with(i, others, cases, outcome.models)) continue;
                      outcome.status = "ok";
                      break;
                    }
                    return outcome;
                  }});
    stop_if_unfinished(outcomes);
    std::vector<std::size_t> read;
    for (std::size_t i = 0; i < middle.size(); ++i) {
      const std::size_t constant = fit_.subject.constants[i];
      if (outcomes[i]->status == unread)
        fit_.result.left_out.push_back({constant, unread});
      else
        read.push_back(constant);
    }
    fit_.subject.constants = std::move(read);
  }

  SubjectFit fit_;
  std::unique_ptr<CalibrationMethod> method_;
};

/// "hunt_crossley: error 1.02": message on a subject that is done.
std::string message_on(const CalibrationSubject& subject, const SubjectCalibration& result) {
  if (result.status != "ok") return subject.info.name + ": " + result.status;
  return fmt::format("{}: error {}", subject.info.name, text::rounded(result.error, "not known"));
}

/// Warning of the step with the fitted constants; none where nothing was fitted.
std::optional<std::string> step_warning_of(const CalibrationPlan& plan,
                                           const CalibrationSubject& subject,
                                           const SubjectCalibration& result) {
  if (result.constants.empty()) return std::nullopt;
  std::vector<ConstantSetting> settings;
  for (const FittedConstant& fitted : result.constants) {
    const VariedConstant& constant = plan.varied[fitted.constant];
    settings.push_back(constant.setting(exact_value(constant, fitted.share)));
  }
  auto warning = step_warning(*subject.scene, settings);
  if (warning) warning = subject.info.name + ", fitted constants: " + *warning;
  return warning;
}

}  // namespace

std::string_view name_of(FitStage stage) {
  switch (stage) {
    case FitStage::start:
      return "start";
    case FitStage::refined:
      return "refined";
    case FitStage::search:
      return "search";
    case FitStage::axis:
      return "axis";
    case FitStage::profile:
      return "profile";
    case FitStage::resample:
      return "resample";
    case FitStage::fold:
      return "fold";
  }
  return "";
}

std::string_view range_end(double share) {
  return share < end_part ? "lower" : share > 1. - end_part ? "upper" : "";
}

bool folds_search_whole_box(const CalibrationPlan& plan) {
  return plan.most_cases == 0 || 2 * plan.most_cases > plan.cases.size();
}

std::optional<double> error_of(const Residuals& residuals) {
  if (residuals.empty()) return std::nullopt;
  return std::sqrt(sum_of_squares(residuals) / static_cast<double>(residuals.size()));
}

CalibrationRun run_calibration(const CalibrationPlan& plan, const EngineTable& engines,
                               const CalibrationOptions& options, const std::atomic<bool>& stop) {
  CalibrationRun run;
  run.folder = options.run.folder.empty() ? plan.folder() : options.run.folder;
  run.files = std::make_unique<output::ResultFolder>(run.folder, manifest_of(plan.runs),
                                                     calibration_files(plan));
  std::size_t total = 0;
  for (const CalibrationSubject& subject : plan.subjects) total += rows_of(plan, subject);
  CachedRuns runs(plan.runs.name, options.run, run.folder, total, stop);
  for (const CalibrationSubject& subject : plan.subjects) {
    SubjectStages stages(plan, subject, engines, runs, stop);
    const bool whole = stages.run();
    run.result.subjects.push_back(stages.take());
    if (options.tell) options.tell(message_on(subject, run.result.subjects.back()));
    const auto warning = step_warning_of(plan, subject, run.result.subjects.back());
    if (warning && options.run.tell) options.run.tell(*warning);
    run.result.interrupted = !whole;
    if (!whole) break;
  }
  run.provenance = make_provenance(plan.runs, engines);
  run.provenance.seeds.push_back(plan.seed);
  return run;
}

}  // namespace hookpoint::studies
