// The folders of the project and of its build.
#pragma once

#include <string>

namespace hookpoint::testing {

/// Absolute path of the project, without a slash at its end.
std::string source_folder();

/// Absolute path of the build folder: the program, plugins.
std::string build_folder();

}  // namespace hookpoint::testing
