// What a file asks of `tune`, all of it planned before anything runs.
#pragma once

#include <filesystem>
#include <optional>
#include <string>
#include <vector>

#include "application/application.h"
#include "application/study_arguments.h"
#include "studies/tune/problem.h"
#include "studies/tune/tune.h"

namespace hookpoint::application {

/// Whether a file that was evaluated holds a Tune or a Calibrate.
bool holds_tune(const language::Object& root);

/// The plans of all Tune blocks of `root`, evaluated from `arguments.file`, one a subject; nothing
/// after errors, which are told. The application outlives them.
std::optional<std::vector<studies::TunePlan>> plan_tune_file(Application& application,
                                                             const language::Object& root,
                                                             const StudyArguments& arguments);

/// "hookpoint tune FILE ..." as it was called.
std::string tune_command(const StudyArguments& arguments);

/// Figures, report.html and all other files of a tuning, and the folder's list of them. What could
/// not be drawn comes back. Throws output::FileError.
std::vector<std::string> write_tuning(const studies::TuneRun& run, const studies::TunePlan& plan,
                                      const std::string& command);

}  // namespace hookpoint::application
