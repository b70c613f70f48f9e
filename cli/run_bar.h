// What the runs of Studies and of Walls share on the command line.
#pragma once

#include <filesystem>
#include <optional>
#include <string>

#include "cli/commands.h"
#include "output/progress.h"
#include "studies/run.h"

namespace hookpoint::cli {

/// The progress bar of a run; it appears with the first row that is done.
class RunBar {
 public:
  explicit RunBar(std::string name) : name_(std::move(name)) {}
  void show(const studies::Progress& progress);
  void end() { bar_.reset(); }

 private:
  std::string name_;
  std::optional<output::Progress> bar_;
  std::size_t shown_ = 0;
};

/// Options of one Study or Wall that runs into `folder` (empty: runs/NAME-HASH); `bar` outlives the
/// run.
studies::RunOptions run_options(const StudyArguments& arguments,
                                const std::filesystem::path& folder, RunBar& bar);

/// Says that what is finished is kept in `folder`, and how to go on: `command` with the folder that
/// the arguments name. The exit status.
int interrupted(const std::filesystem::path& folder, const std::string& command,
                const StudyArguments& arguments);

}  // namespace hookpoint::cli
