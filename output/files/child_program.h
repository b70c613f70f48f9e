// Another program beside this one, which it talks to and which ends with it. run_program (child.h)
// is for those that are waited for.
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
    std::filesystem::path folder{};  ///< it runs there; empty: here
    bool hears = false;              ///< it has something to read (say); else /dev/null
    bool ends_with_thread = true;    ///< it is ended when the thread that started it ends
  };

  /// Starts it without a shell, in a process group of its own. Throws std::system_error.
  ChildProgram(const std::filesystem::path& program, const std::vector<std::string>& arguments)
      : ChildProgram(program, arguments, Options{}) {}
  ChildProgram(const std::filesystem::path& program, const std::vector<std::string>& arguments,
               const Options& options);
  /// Ends it and what it has started: asks, and after a moment insists.
  ~ChildProgram();
  ChildProgram(const ChildProgram&) = delete;
  ChildProgram& operator=(const ChildProgram&) = delete;

  bool running();
  /// How it ended, which it has: "exit status 3", "signal 9".
  std::string end() const;
  /// Ends it at once.
  void kill();

  /// The next whole line of its standard output; none while there is none.
  std::optional<std::string> take_line();
  /// What it has written to standard error, the last of it.
  const std::string& errors();
  /// The whole lines of that which were not taken yet, the first of them where they are many.
  std::vector<std::string> take_error_lines();

  /// How a talk went.
  enum class Talk {
    done,
    late,   ///< not until the deadline
    closed  ///< it does not read, or write, any more
  };
  /// Hands it all of `bytes` to read.
  Talk say(std::string_view bytes, Clock::time_point until);
  /// Takes exactly `count` bytes of its standard output, in the place of `bytes`.
  Talk hear(std::size_t count, std::string& bytes, Clock::time_point until);

 private:
  /// Waits until it takes or gives something, and takes what it gives; false at the deadline.
  bool wait(bool to_say, Clock::time_point until);

  pid_t process_ = -1;
  bool ended_ = false;
  int status_ = 0;                              ///< of waitpid
  int input_ = -1, output_ = -1, errors_ = -1;  ///< ends of a socket and of pipes
  bool output_closed_ = false, errors_closed_ = false;
  void read_errors();

  std::string unread_, error_text_, error_lines_;
};

/// The program that PATH holds under `name`, or the file `name` where that is a path; empty where
/// there is none that may be run. Relative folders of PATH are left out: a child runs in a folder
/// where anybody may have put a program.
std::filesystem::path program_on_path(const std::string& name);

}  // namespace hookpoint::output
