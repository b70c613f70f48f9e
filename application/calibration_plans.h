// What a file's Calibrate blocks ask of `tune`, all of it planned before anything runs.
#pragma once

#include <optional>
#include <string>
#include <vector>

#include "application/application.h"
#include "application/study_arguments.h"
#include "studies/calibrate/calibrate.h"
#include "studies/calibrate/problem.h"

namespace hookpoint::application {

/// The plans of all Calibrate blocks of `root`, evaluated from `arguments.file`; nothing after
/// errors, which are told. The application outlives them.
std::optional<std::vector<studies::CalibrationPlan>> plan_calibrate_file(
    Application& application, const language::Object& root, const StudyArguments& arguments);

/// Figures, report.html and all other files of a calibration, and the folder's list of them. What
/// could not be drawn comes back. Throws output::FileError.
std::vector<std::string> write_calibration(const studies::CalibrationRun& run,
                                           const studies::CalibrationPlan& plan,
                                           const std::string& command);

}  // namespace hookpoint::application
