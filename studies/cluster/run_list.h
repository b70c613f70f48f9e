// Runs as a file, for another process to make.
#pragma once

#include <filesystem>
#include <string>
#include <vector>

#include "studies/run/runs.h"

namespace hookpoint::studies {

/// Not a list of runs, or one that this program cannot make.
struct RunListError : std::runtime_error {
  using std::runtime_error::runtime_error;
};

/// Beside this program's own.
struct ForeignCode {
  bool allow_plugins = false, allow_engines = false;  ///< of any folder
  std::vector<std::string> engine_files{};            ///< with the blocks of engines, absolute
};

struct RunList {
  ForeignCode code;
  std::vector<RunRequest> runs;
};

/// JSON; paths absolute.
std::string run_list_text(const RunList& list);
/// Throws RunListError.
RunList read_run_list(const std::filesystem::path& file);

}  // namespace hookpoint::studies
