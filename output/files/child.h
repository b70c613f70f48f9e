// Other programs, started without a shell: what stands in an argument is never a command.
#pragma once

#include <atomic>
#include <filesystem>
#include <limits>
#include <optional>
#include <string>
#include <vector>

namespace hookpoint::output {

struct ChildResult {
  int status = -1;       ///< exit status; 128 + the signal that ended it
  std::string output;    ///< what it wrote to standard output and, unless apart, standard error
  std::string errors;    ///< what it wrote to standard error, apart
  bool stopped = false;  ///< with all that it started, for a limit or a stop
};

struct ChildOptions {
  bool errors_apart = false;
  double most_seconds = std::numeric_limits<double>::infinity();
  std::size_t most_bytes = std::numeric_limits<std::size_t>::max();  ///< that it writes
  const std::atomic<bool>* stop = nullptr;  ///< once true, the program is stopped
};

/// Runs the program that PATH's absolute folders hold under `name`, in `folder`, with C's locale,
/// in UTC and with nothing to read, and waits for its end. Nothing when there is no such program.
std::optional<ChildResult> run_program(const std::string& name,
                                       const std::vector<std::string>& arguments,
                                       const std::filesystem::path& folder,
                                       const ChildOptions& options = {});

}  // namespace hookpoint::output
