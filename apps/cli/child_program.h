// Another program beside this one: its lines are read without waiting, and it ends with this one.
#pragma once

#include <sys/types.h>

#include <filesystem>
#include <optional>
#include <string>
#include <vector>

namespace hookpoint::cli {

class ChildProgram {
 public:
  /// Starts it without a shell, with nothing to read, in a process group of its own. It is ended
  /// too when the calling thread ends. Throws std::system_error.
  ChildProgram(const std::filesystem::path& program, const std::vector<std::string>& arguments);
  /// Ends it and what it has started: asks, and after a moment insists.
  ~ChildProgram();
  ChildProgram(const ChildProgram&) = delete;
  ChildProgram& operator=(const ChildProgram&) = delete;

  bool running();
  /// The next whole line of its standard output; none while there is none.
  std::optional<std::string> take_line();
  /// What it has written to standard error, the last of it.
  const std::string& errors();

 private:
  pid_t process_ = -1;
  bool ended_ = false;
  int output_ = -1, errors_ = -1;  ///< ends of pipes
  std::string unread_, error_text_;
};

}  // namespace hookpoint::cli
