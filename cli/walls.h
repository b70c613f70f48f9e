// The Walls of a file that `hookpoint study` runs.
#pragma once

#include "cli/application.h"
#include "cli/commands.h"

namespace hookpoint::cli {

/// Plans all, then runs all, each with its progress bar, table, files and report. The exit status.
int run_walls(Application& application, const language::Object& root,
              const StudyArguments& arguments, const std::string& command);

}  // namespace hookpoint::cli
