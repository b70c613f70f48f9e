// A Calibrate block, checked: measured curves, constants and the subjects whose constants are
// fitted.
#pragma once

#include <cstddef>
#include <cstdint>
#include <filesystem>
#include <memory>
#include <optional>
#include <string>
#include <vector>

#include "language/document/document.h"
#include "studies/blocks/calibrate.h"
#include "studies/calibrate/least_squares.h"
#include "studies/measure/engine_table.h"
#include "studies/measurements/trace_plan.h"
#include "studies/plan/plan.h"
#include "studies/search/optimiser.h"
#include "studies/search/varied_constant.h"

namespace hookpoint::studies {

/// What was measured in one run: what its scene is set to, and the curves. Traces with the same Fix
/// blocks are of one case, and each row of a Cases block's table is one.
struct CalibrationCase {
  std::string name;  ///< of its traces, joined; or the Cases', and what its table calls the case
  std::vector<ConstantSetting> settings;
  std::vector<TracePlan> traces;

  std::size_t residuals() const;  ///< of all its traces
};

/// A constant that a subject's calibration does without.
struct LeftOut {
  std::size_t constant = 0;
  std::string reason;
};

/// A law, or an engine with its settings, and which of the constants it reads.
struct CalibrationSubject {
  SubjectInfo info;
  std::shared_ptr<const VariedScene> scene;
  std::vector<std::size_t> constants;  ///< indices into CalibrationPlan::varied
  std::vector<LeftOut> left_out;
  std::string refusal;    ///< why it cannot run the scene; "" when it can
  std::string runs_hash;  ///< of all that decides a run but constants and cases
};

/// A constant that is no constant of the scene: what the clock of a trace reads at time 0.
struct FittedOffset {
  std::size_t constant = 0;  ///< index into CalibrationPlan::varied
  std::string trace;         ///< name
};

struct CalibrationPlan : CalibrationWork {
  StudyPlan runs;  ///< name, file, texts, hash and inputs, for what tells of the folder; no rows
  std::string material;
  std::vector<VariedConstant> varied;
  std::vector<std::optional<double>> own;  ///< values of the scene itself, one a constant
  std::vector<FittedOffset> offsets;
  std::vector<CalibrationCase> cases;
  std::vector<CalibrationSubject> subjects;
  std::vector<std::filesystem::path> case_tables;

  std::size_t residuals() const;  ///< of all cases
  /// The offset that a constant is; null where it is one of the scene.
  const FittedOffset* offset_of(std::size_t constant) const;
  std::filesystem::path folder() const { return runs.folder(); }
  /// Whether cases are resampled, not the samples of each.
  bool resamples_cases() const;
};

/// Of how many cases on the bootstrap is over cases.
inline constexpr std::size_t least_cases_to_resample = 5;
/// The best of the starts, that are refined.
inline constexpr std::size_t refined_starts = 3;

/// The value of a constant at a share of its range, to all digits.
double exact_value(const VariedConstant& constant, double share);

/// Nothing when `diagnostics` got an error. The library outlives it. Reads every trace and loads
/// the scene under every subject.
std::optional<CalibrationPlan> make_calibration_plan(const language::Object& root,
                                                     const language::Object& calibrate,
                                                     const std::string& file,
                                                     language::Library& library,
                                                     const EngineTable& engines, bool quick,
                                                     language::Diagnostics& diagnostics);

}  // namespace hookpoint::studies
