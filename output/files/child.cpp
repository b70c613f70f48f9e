#include "output/files/child.h"

#include <fcntl.h>
#include <poll.h>
#include <spawn.h>
#include <sys/wait.h>
#include <unistd.h>

#include <algorithm>
#include <array>
#include <cerrno>
#include <chrono>
#include <cmath>
#include <csignal>
#include <cstdint>
#include <string_view>

#include "output/files/child_program.h"
#include "output/files/file.h"

extern char** environ;

namespace hookpoint::output {
namespace {

/// The environment with C's locale and UTC in it.
std::vector<std::string> child_environment() {
  std::vector<std::string> variables{"LC_ALL=C", "TZ=UTC"};
  for (char** variable = environ; *variable != nullptr; ++variable) {
    const std::string_view text = *variable;
    if (!text.starts_with("LC_ALL=") && !text.starts_with("TZ=")) variables.emplace_back(text);
  }
  return variables;
}

std::vector<char*> pointers_to(std::vector<std::string>& words) {
  std::vector<char*> pointers;
  for (std::string& word : words) pointers.push_back(word.data());
  pointers.push_back(nullptr);
  return pointers;
}

/// A pipe that the child writes into.
class Pipe {
 public:
  /// Throws FileError.
  explicit Pipe(const std::filesystem::path& program) {
    if (::pipe2(ends_, O_CLOEXEC) != 0) fail_file("start", program);
  }
  ~Pipe() {
    close_written();
    ::close(ends_[0]);
  }
  Pipe(const Pipe&) = delete;
  Pipe& operator=(const Pipe&) = delete;

  int read_end() const { return ends_[0]; }
  int written_end() const { return ends_[1]; }
  void close_written() {
    if (ends_[1] >= 0) ::close(ends_[1]);
    ends_[1] = -1;
  }

 private:
  int ends_[2] = {-1, -1};
};

/// What becomes of the child's streams and signals.
class SpawnPlan {
 public:
  /// `own_group`: it can be stopped with all that it starts.
  SpawnPlan(const std::filesystem::path& folder, int output, int errors, bool own_group) {
    posix_spawn_file_actions_init(&actions_);
    posix_spawn_file_actions_addchdir_np(&actions_, folder.c_str());
    posix_spawn_file_actions_addopen(&actions_, STDIN_FILENO, "/dev/null", O_RDONLY, 0);
    posix_spawn_file_actions_adddup2(&actions_, output, STDOUT_FILENO);
    posix_spawn_file_actions_adddup2(&actions_, errors, STDERR_FILENO);
    posix_spawnattr_init(&attributes_);
    sigset_t usual;
    sigemptyset(&usual);
    for (const int number : {SIGPIPE, SIGXFSZ}) sigaddset(&usual, number);
    posix_spawnattr_setsigdefault(&attributes_, &usual);
    posix_spawnattr_setpgroup(&attributes_, 0);
    posix_spawnattr_setflags(
        &attributes_,
        static_cast<short>(POSIX_SPAWN_SETSIGDEF | (own_group ? POSIX_SPAWN_SETPGROUP : 0)));
  }
  ~SpawnPlan() {
    posix_spawn_file_actions_destroy(&actions_);
    posix_spawnattr_destroy(&attributes_);
  }
  SpawnPlan(const SpawnPlan&) = delete;
  SpawnPlan& operator=(const SpawnPlan&) = delete;
  const posix_spawn_file_actions_t* actions() const { return &actions_; }
  const posix_spawnattr_t* attributes() const { return &attributes_; }

 private:
  posix_spawn_file_actions_t actions_;
  posix_spawnattr_t attributes_;
};

/// Until when a child may run.
class Deadline {
 public:
  Deadline(double seconds, const std::atomic<bool>* stop)
      : timed_(std::isfinite(seconds)), stop_(stop) {
    using namespace std::chrono;
    if (timed_) end_ = steady_clock::now() + duration_cast<milliseconds>(duration<double>(seconds));
  }
  bool limited() const { return timed_ || stop_ != nullptr; }
  bool over() const {
    return (timed_ && std::chrono::steady_clock::now() >= end_) || (stop_ != nullptr && *stop_);
  }
  /// For poll(): time until the next check [ms], -1 for any time.
  int left() const {
    using namespace std::chrono;
    constexpr std::int64_t between_checks = 200;
    if (!limited()) return -1;
    std::int64_t left = between_checks;
    if (timed_) left = ceil<milliseconds>(end_ - steady_clock::now()).count();
    if (stop_ != nullptr) left = std::min(left, between_checks);
    return static_cast<int>(std::max<std::int64_t>(0, left));
  }

 private:
  bool timed_;
  const std::atomic<bool>* stop_;
  std::chrono::steady_clock::time_point end_;
};

/// Reads what the child writes until it closes its ends; false when it went beyond a limit.
bool read_all(int output, int errors, const Deadline& deadline, std::size_t most_bytes,
              ChildResult& result) {
  std::array<pollfd, 2> ends{{{output, POLLIN, 0}, {errors, POLLIN, 0}}};
  std::array<char, 4096> buffer;
  while (ends[0].fd >= 0 || ends[1].fd >= 0) {
    const int ready = ::poll(ends.data(), ends.size(), deadline.left());
    if (ready < 0 && errno != EINTR) return true;
    if (deadline.over()) return false;
    for (pollfd& end : ends) {
      if (ready <= 0 || end.fd < 0 || end.revents == 0) continue;
      const ssize_t count = ::read(end.fd, buffer.data(), buffer.size());
      if (count < 0 && errno == EINTR) continue;
      if (count <= 0) {
        end.fd = -1;
        continue;
      }
      std::string& text = &end == &ends[0] ? result.output : result.errors;
      text.append(buffer.data(), static_cast<std::size_t>(count));
      if (result.output.size() + result.errors.size() > most_bytes) return false;
    }
  }
  return true;
}

/// Waits for the child's end; one that outlives the deadline is stopped.
void wait_for(pid_t child, const Deadline& deadline, ChildResult& result) {
  int raw = 0;
  while (true) {
    if (!result.stopped && deadline.over()) result.stopped = true;
    if (result.stopped) ::kill(-child, SIGKILL);
    const bool look = deadline.limited() && !result.stopped;
    const pid_t ended = ::waitpid(child, &raw, look ? WNOHANG : 0);
    if (ended == child) break;
    if (ended < 0 && errno != EINTR) return;
    constexpr int pause = 5;  // [ms]
    if (look) ::poll(nullptr, 0, pause);
  }
  result.status = WIFEXITED(raw) ? WEXITSTATUS(raw) : 128 + WTERMSIG(raw);
}

}  // namespace

std::optional<ChildResult> run_program(const std::string& name,
                                       const std::vector<std::string>& arguments,
                                       const std::filesystem::path& folder,
                                       const ChildOptions& options) {
  const std::filesystem::path program = program_on_path(name);
  if (program.empty()) return std::nullopt;
  std::vector<std::string> words{name}, variables = child_environment();
  words.insert(words.end(), arguments.begin(), arguments.end());
  Pipe output(program), errors(program);
  const Deadline deadline(options.most_seconds, options.stop);
  const bool limited =
      deadline.limited() || options.most_bytes != std::numeric_limits<std::size_t>::max();
  pid_t child = 0;
  const SpawnPlan plan(folder, output.written_end(),
                       options.errors_apart ? errors.written_end() : output.written_end(), limited);
  const int refused = ::posix_spawn(&child, program.c_str(), plan.actions(), plan.attributes(),
                                    pointers_to(words).data(), pointers_to(variables).data());
  output.close_written();
  errors.close_written();
  errno = refused;
  if (refused != 0) fail_file("start", program);
  ChildResult result;
  result.stopped =
      !read_all(output.read_end(), errors.read_end(), deadline, options.most_bytes, result);
  wait_for(child, deadline, result);
  return result;
}

}  // namespace hookpoint::output
