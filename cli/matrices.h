// The Matrix blocks of a file.
#pragma once

#include <string>

#include "cli/application.h"
#include "cli/commands.h"

namespace hookpoint::cli {

/// Runs every Matrix of `root`: its studies one after the other, each into a folder of its own
/// beside matrix.html. `command` runs it again. Returns the exit status.
int run_matrices(Application& application, const language::Object& root,
                 const StudyArguments& arguments, const std::string& command);

}  // namespace hookpoint::cli
