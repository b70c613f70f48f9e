// Blocks of a file that run on the command line: progress bar, files, table on stdout or in a
// browser, exit status.
#pragma once

#include <filesystem>
#include <memory>
#include <string>

#include "application/application.h"
#include "application/study_plans.h"
#include "cli/interrupt.h"
#include "cli/study_view.h"

namespace hookpoint::cli {

/// What the runs of one command share.
struct StudyCommand {
  const studies::EngineTable& engines;
  const application::StudyArguments& arguments;
  const application::StudyFile& file;
  std::string command;  ///< that does all again
  const InterruptGuard& guard;
  StudyView* view = nullptr;  ///< where it is watched; stdout then has nothing of it
  std::shared_ptr<studies::RunStore> store{};  ///< of all its blocks; null: each has its own

  /// Where the results of this Study or Matrix go.
  template <class Plan>
  std::filesystem::path folder(const Plan& plan) const {
    return file.folder(arguments.out, plan.name, plan.hash);
  }
};

/// The scripts that the studies would be submitted with, on stdout.
int print_slurm_scripts(const StudyCommand& command);

/// Each returns the exit status.
int run_one_study(const StudyCommand& command, const studies::StudyPlan& plan);
int run_one_wall(const StudyCommand& command, const studies::WallPlan& plan);
/// Its studies one after the other, each into a folder of its own beside matrix.html.
int run_one_matrix(const StudyCommand& command, const application::MatrixPlan& plan);

}  // namespace hookpoint::cli
