#include "output/files/child_program.h"

#include <fcntl.h>
#include <poll.h>
#include <signal.h>
#include <sys/prctl.h>
#include <sys/socket.h>
#include <sys/wait.h>
#include <unistd.h>

#include <algorithm>
#include <array>
#include <cerrno>
#include <cstdlib>
#include <sstream>
#include <system_error>
#include <thread>
#include <utility>

namespace hookpoint::output {
namespace {

using std::chrono::milliseconds;

constexpr milliseconds farewell_time{2000};
constexpr std::size_t most_error_text = 8192, most_error_lines = 65536;

/// Two ends of a pipe, or of a socket, which can be written without a signal when nobody reads.
struct Ends {
  enum class Kind { pipe, socket };
  explicit Ends(Kind kind) {
    const int failed = kind == Kind::pipe
                           ? pipe2(ends.data(), O_CLOEXEC)
                           : socketpair(AF_UNIX, SOCK_STREAM | SOCK_CLOEXEC, 0, ends.data());
    if (failed != 0)
      throw std::system_error(errno, std::generic_category(), "no program can be started");
    fcntl(ends[0], F_SETFL, O_NONBLOCK);
  }
  ~Ends() {
    for (const int end : ends)
      if (end >= 0) close(end);
  }
  Ends(const Ends&) = delete;
  Ends& operator=(const Ends&) = delete;
  int take_own() { return std::exchange(ends[0], -1); }

  std::array<int, 2> ends{-1, -1};  ///< ours, which never waits, and the program's
};

/// What is there now; false once the other end is closed.
bool read_on(int descriptor, std::string& text) {
  std::array<char, 65536> buffer;
  while (true) {
    const ssize_t count = ::read(descriptor, buffer.data(), buffer.size());
    if (count < 0 && errno == EINTR) continue;
    if (count <= 0) return count < 0;
    text.append(buffer.data(), static_cast<std::size_t>(count));
  }
}

/// For poll() [ms].
int left_until(ChildProgram::Clock::time_point until) {
  const auto left = std::chrono::ceil<milliseconds>(until - ChildProgram::Clock::now()).count();
  return static_cast<int>(std::clamp<decltype(left)>(left, 0, 3'600'000));
}

}  // namespace

ChildProgram::ChildProgram(const std::filesystem::path& program,
                           const std::vector<std::string>& arguments, const Options& options) {
  std::vector<std::string> words{program.string()};
  words.insert(words.end(), arguments.begin(), arguments.end());
  std::vector<char*> pointers;
  for (std::string& word : words) pointers.push_back(word.data());
  pointers.push_back(nullptr);
  Ends input(Ends::Kind::socket), output(Ends::Kind::pipe), errors(Ends::Kind::pipe);
  const pid_t parent = getpid();
  process_ = fork();
  if (process_ < 0)
    throw std::system_error(errno, std::generic_category(),
                            program.string() + " cannot be started");
  if (process_ == 0) {
    // Other threads are not here: nothing that takes a lock or allocates.
    setpgid(0, 0);
    if (options.ends_with_thread) prctl(PR_SET_PDEATHSIG, SIGTERM);
    if (getppid() != parent) _exit(127);
    sigset_t none;
    sigemptyset(&none);
    sigprocmask(SIG_SETMASK, &none, nullptr);
    for (const int number : {SIGPIPE, SIGINT, SIGTERM, SIGHUP, SIGXFSZ}) signal(number, SIG_DFL);
    dup2(options.takes_input ? input.ends[1] : open("/dev/null", O_RDONLY), STDIN_FILENO);
    dup2(output.ends[1], STDOUT_FILENO);
    dup2(errors.ends[1], STDERR_FILENO);
    if (!options.folder.empty() && chdir(options.folder.c_str()) != 0) _exit(127);
    execv(pointers.front(), pointers.data());
    _exit(127);
  }
  setpgid(process_, process_);  // here and there: whichever comes first
  input_ = input.take_own();
  output_ = output.take_own();
  errors_ = errors.take_own();
}

ChildProgram::~ChildProgram() {
  close(input_);
  if (running()) ::kill(process_, SIGTERM);
  const auto until = Clock::now() + farewell_time;
  while (running() && Clock::now() < until) {
    // A pipe that is full would hold it up.
    read_on(output_, unread_);
    read_errors();
    std::this_thread::sleep_for(milliseconds(5));
  }
  kill();
  close(output_);
  close(errors_);
}

bool ChildProgram::running() {
  if (!ended_) ended_ = waitpid(process_, &status_, WNOHANG) == process_;
  return !ended_;
}

std::string ChildProgram::end() const {
  return WIFSIGNALED(status_) ? "signal " + std::to_string(WTERMSIG(status_))
                              : "exit status " + std::to_string(WEXITSTATUS(status_));
}

void ChildProgram::kill() {
  ::kill(-process_, SIGKILL);
  if (!ended_) ended_ = waitpid(process_, &status_, 0) == process_;
}

std::optional<std::string> ChildProgram::take_line() {
  read_on(output_, unread_);
  const std::size_t end = unread_.find('\n');
  if (end == std::string::npos) return std::nullopt;
  std::string line = unread_.substr(0, end);
  unread_.erase(0, end + 1);
  return line;
}

const std::string& ChildProgram::errors() {
  read_errors();
  return error_text_;
}

void ChildProgram::read_errors() {
  std::string text;
  errors_closed_ = !read_on(errors_, text) || errors_closed_;
  error_text_ += text;
  if (error_text_.size() > most_error_text)
    error_text_.erase(0, error_text_.size() - most_error_text);
  if (error_lines_.size() < most_error_lines) error_lines_ += text;
}

std::vector<std::string> ChildProgram::take_error_lines() {
  read_errors();
  std::vector<std::string> lines;
  for (std::size_t end; (end = error_lines_.find('\n')) != std::string::npos;) {
    lines.push_back(error_lines_.substr(0, end));
    error_lines_.erase(0, end + 1);
  }
  return lines;
}

bool ChildProgram::wait(bool to_write, Clock::time_point until) {
  // What it writes is taken meanwhile: a pipe that is full would hold it up.
  std::array<pollfd, 3> ends{{{output_closed_ ? -1 : output_, POLLIN, 0},
                              {errors_closed_ ? -1 : errors_, POLLIN, 0},
                              {to_write ? input_ : -1, POLLOUT, 0}}};
  const int ready = poll(ends.data(), ends.size(), left_until(until));
  if (ready == 0 && Clock::now() >= until) return false;
  if (ready <= 0) return true;
  if (ends[0].revents != 0) output_closed_ = !read_on(output_, unread_);
  if (ends[1].revents != 0) read_errors();
  return true;
}

ChildProgram::Transfer ChildProgram::write(std::string_view bytes, Clock::time_point until) {
  while (!bytes.empty()) {
    const ssize_t count = send(input_, bytes.data(), bytes.size(), MSG_NOSIGNAL);
    if (count > 0) {
      bytes.remove_prefix(static_cast<std::size_t>(count));
    } else if (count < 0 && errno != EAGAIN && errno != EINTR) {
      return Transfer::closed;
    } else if (!wait(true, until)) {
      return Transfer::late;
    }
  }
  return Transfer::done;
}

ChildProgram::Transfer ChildProgram::read(std::size_t count, std::string& bytes,
                                          Clock::time_point until) {
  while (unread_.size() < count) {
    if (output_closed_) return Transfer::closed;
    if (!wait(false, until)) return Transfer::late;
  }
  bytes.assign(unread_, 0, count);
  unread_.erase(0, count);
  return Transfer::done;
}

std::filesystem::path program_on_path(const std::string& name) {
  const auto runs = [](const std::filesystem::path& file) {
    std::error_code ignored;
    return std::filesystem::is_regular_file(file, ignored) && access(file.c_str(), X_OK) == 0;
  };
  if (name.find('/') != std::string::npos)
    return runs(name) ? std::filesystem::path(name) : std::filesystem::path{};
  const char* path = std::getenv("PATH");
  std::istringstream folders(path == nullptr ? "/usr/local/bin:/usr/bin:/bin" : path);
  for (std::string folder; std::getline(folders, folder, ':');) {
    const std::filesystem::path candidate = std::filesystem::path(folder) / name;
    if (candidate.is_absolute() && runs(candidate)) return candidate;
  }
  return {};
}

}  // namespace hookpoint::output
