// What lies beside the results of `study`: reports and their like. Shared by the command and by
// Python.
#pragma once

#include <filesystem>
#include <string>

#include "cli/study_plans.h"
#include "studies/matrix.h"
#include "studies/report.h"
#include "studies/run.h"
#include "studies/wall.h"

namespace hookpoint::cli {

/// Figures and report.html of a study that ran to its end. `command` runs it again. Throws
/// output::FileError, as do all here.
studies::ReportOutcome write_study_report(const studies::StudyRun& run, const std::string& command);

/// All files of a Wall that ran.
void write_wall(const std::filesystem::path& folder, const studies::WallPlan& plan,
                const studies::WallResult& result, const studies::EngineTable& engines,
                const std::string& command);

/// The result of a matrix with no study in it yet.
studies::MatrixResult begin_matrix(const MatrixPlan& plan, const std::filesystem::path& file);

/// The files of a Matrix beside the folders of its studies. `text`: its file as printed.
void write_matrix(const std::filesystem::path& folder, const MatrixPlan& plan,
                  const studies::MatrixResult& result, const std::string& text,
                  const studies::EngineTable& engines, const std::string& command);

}  // namespace hookpoint::cli
