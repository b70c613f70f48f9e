// A program that runs beside this one, with pipes to its standard streams. run_program (child.h) runs a
// program and waits for its end.
#pragma once

#include <sys/types.h>

#include <chrono>
#include <filesystem>
#include <optional>
#include <string>
#include <string_view>
#include <vector>

namespace hookpoint::output {

class ChildProgram {
 public:
  using Clock = std::chrono::steady_clock;
  struct Options {
    std::filesystem::path folder{};  ///< working folder; empty: that of this process
    bool takes_input = false;        ///< standard input is a pipe (write()); else /dev/null
    bool ends_with_thread = true;    ///< SIGTERM when the thread that started it ends
  };

  /// Starts it without a shell, in a process group of its own. Throws std::system_error.
  ChildProgram(const std::filesystem::path& program, const std::vector<std::string>& arguments)
      : ChildProgram(program, arguments, Options{}) {}
  ChildProgram(const std::filesystem::path& program, const std::vector<std::string>& arguments,
               const Options& options);
  /// Ends it and what it has started: SIGTERM, and after two seconds SIGKILL.
  ~ChildProgram();
  ChildProgram(const ChildProgram&) = delete;
  ChildProgram& operator=(const ChildProgram&) = delete;

  bool running();
  /// How a program that has ended did so: "exit status 3", "signal 9".
  std::string end() const;
  /// Ends it and what it has started at once (SIGKILL).
  void kill();

  /// The next whole line of its standard output; none while there is none.
  std::optional<std::string> take_line();
  /// The last 8 KiB of its standard error.
  const std::string& errors();
  /// Whole lines of its standard error since the last call; of more than 64 KiB the first.
  std::vector<std::string> take_error_lines();

  enum class Transfer {
    done,
    late,   ///< the deadline passed
    closed  ///< the program has closed its end
  };
  /// Writes all of `bytes` to its standard input, until the deadline `until` at most.
  Transfer write(std::string_view bytes, Clock::time_point until);
  /// Reads exactly `count` bytes of its standard output into `bytes`.
  Transfer read(std::size_t count, std::string& bytes, Clock::time_point until);

 private:
  /// Waits until a stream is ready, and reads what is there; false at the deadline.
  bool wait(bool to_write, Clock::time_point until);
  void read_errors();

  pid_t process_ = -1;
  bool ended_ = false;
  int status_ = 0;                              ///< of waitpid
  int input_ = -1, output_ = -1, errors_ = -1;  ///< ends of a socket and of pipes
  bool output_closed_ = false, errors_closed_ = false;
  std::string unread_, error_text_, error_lines_;
};

/// The program that PATH holds under `name`, or the file `name` where that is a path; empty where
/// there is none that may be run. Relative folders of PATH are left out: a child runs in a folder
/// where anybody may have put a program.
std::filesystem::path program_on_path(const std::string& name);

}  // namespace hookpoint::output
