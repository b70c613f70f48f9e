// What lies beside the results of `study`: reports and their like. Shared by the command and by
// Python.
#pragma once

#include <filesystem>
#include <memory>
#include <string>
#include <vector>

#include "application/study_plans.h"
#include "output/result_folder.h"
#include "studies/compare/wall.h"
#include "studies/report/matrix.h"
#include "studies/report/report.h"
#include "studies/run/run.h"

namespace hookpoint::application {

/// Figures and report.html of a study that ran to its end. `command` runs it again. Throws
/// output::FileError, as do all here.
studies::ReportOutcome write_study_report(const studies::StudyRun& run, const std::string& command);
/// That report once more, with links to `pictures`, files of its folder, beside its own.
void link_pictures(const studies::StudyRun& run, const std::string& command,
                   const studies::ReportOutcome& report, const std::vector<std::string>& pictures);

/// All files of a Wall that ran.
void write_wall(const studies::WallRun& run, const studies::WallPlan& plan,
                const studies::EngineTable& engines, const std::string& command);

/// A Matrix that runs, with the studies that are done.
struct MatrixRun {
  studies::MatrixResult result;
  std::filesystem::path folder;
  std::unique_ptr<output::ResultFolder> files;  ///< locks the folder
  std::shared_ptr<studies::RunStore> store;     ///< of all its studies
};

/// With no study in it yet, in its folder. `store`: that it shares with other blocks; null: it has
/// its own. Throws output::FolderError and studies::StoreError too.
MatrixRun begin_matrix(const MatrixPlan& plan, const StudyArguments& arguments,
                       const std::filesystem::path& folder,
                       std::shared_ptr<studies::RunStore> store);

/// The files of a Matrix beside the folders of its studies. `text`: its file as printed.
void write_matrix(const MatrixRun& run, const MatrixPlan& plan, const std::string& text,
                  const studies::EngineTable& engines, const std::string& command);

}  // namespace hookpoint::application
