// Studies of a file from blocks to finished folders: what `study` does with a file's own and with
// those that a Matrix brings.
#pragma once

#include <filesystem>
#include <optional>
#include <string>
#include <vector>

#include "cli/application.h"
#include "cli/commands.h"
#include "studies/plan.h"
#include "studies/report.h"
#include "studies/result.h"

namespace hookpoint::cli {

/// The plans of all Study blocks of `root`, evaluated from `file`; nothing after errors, which are
/// printed.
std::optional<std::vector<studies::StudyPlan>> plan_studies(Application& application,
                                                            const language::Object& root,
                                                            const std::filesystem::path& file,
                                                            const studies::PlanOptions& options);

/// A study that ran.
struct StudyOutcome {
  int status = 0;                              ///< exit status
  std::optional<studies::StudyResult> result;  ///< none when it was interrupted
  std::vector<studies::ReportFigure> figures;
};

/// Runs one study with its progress bar into `folder` (empty: runs/STUDY-HASH); files and report
/// follow, and with `print_table` the table on stdout. `command` runs it again.
StudyOutcome run_one_study(Application& application, const studies::StudyPlan& plan,
                           const StudyArguments& arguments, const std::filesystem::path& folder,
                           const std::string& command, bool print_table);

/// "hookpoint study FILE ..." as it was called, for another `file`.
std::string rerun_command(const StudyArguments& arguments, const std::filesystem::path& file);

}  // namespace hookpoint::cli
