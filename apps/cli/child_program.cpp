#include "apps/cli/child_program.h"

#include <fcntl.h>
#include <signal.h>
#include <sys/prctl.h>
#include <sys/wait.h>
#include <unistd.h>

#include <array>
#include <cerrno>
#include <chrono>
#include <system_error>
#include <thread>
#include <utility>

namespace hookpoint::cli {
namespace {

using std::chrono::milliseconds;

constexpr milliseconds farewell_time{2000};
constexpr std::size_t most_error_text = 8192;

struct Pipe {
  Pipe() {
    if (pipe2(ends.data(), O_CLOEXEC) != 0)
      throw std::system_error(errno, std::generic_category(), "no program can be started");
    fcntl(ends[0], F_SETFL, O_NONBLOCK);
  }
  ~Pipe() {
    for (const int end : ends)
      if (end >= 0) close(end);
  }
  Pipe(const Pipe&) = delete;
  Pipe& operator=(const Pipe&) = delete;
  int take_reading_end() { return std::exchange(ends[0], -1); }

  std::array<int, 2> ends{-1, -1};
};

/// What is there now.
void read_on(int descriptor, std::string& text) {
  std::array<char, 4096> buffer;
  while (true) {
    const ssize_t count = read(descriptor, buffer.data(), buffer.size());
    if (count < 0 && errno == EINTR) continue;
    if (count <= 0) return;
    text.append(buffer.data(), static_cast<std::size_t>(count));
  }
}

}  // namespace

ChildProgram::ChildProgram(const std::filesystem::path& program,
                           const std::vector<std::string>& arguments) {
  std::vector<std::string> words{program.string()};
  words.insert(words.end(), arguments.begin(), arguments.end());
  std::vector<char*> pointers;
  for (std::string& word : words) pointers.push_back(word.data());
  pointers.push_back(nullptr);
  Pipe output, errors;
  const pid_t parent = getpid();
  process_ = fork();
  if (process_ < 0)
    throw std::system_error(errno, std::generic_category(),
                            program.string() + " cannot be started");
  if (process_ == 0) {
    // Other threads are not here: nothing that takes a lock or allocates.
    setpgid(0, 0);
    prctl(PR_SET_PDEATHSIG, SIGTERM);
    if (getppid() != parent) _exit(127);
    sigset_t none;
    sigemptyset(&none);
    sigprocmask(SIG_SETMASK, &none, nullptr);
    for (const int number : {SIGPIPE, SIGINT, SIGTERM, SIGHUP, SIGXFSZ}) signal(number, SIG_DFL);
    dup2(open("/dev/null", O_RDONLY), STDIN_FILENO);
    dup2(output.ends[1], STDOUT_FILENO);
    dup2(errors.ends[1], STDERR_FILENO);
    execv(pointers.front(), pointers.data());
    _exit(127);
  }
  setpgid(process_, process_);  // here and there: whichever comes first
  output_ = output.take_reading_end();
  errors_ = errors.take_reading_end();
}

ChildProgram::~ChildProgram() {
  if (running()) kill(process_, SIGTERM);
  const auto until = std::chrono::steady_clock::now() + farewell_time;
  while (running() && std::chrono::steady_clock::now() < until) {
    // A pipe that is full would hold it up.
    read_on(output_, unread_);
    read_on(errors_, error_text_);
    std::this_thread::sleep_for(milliseconds(5));
  }
  kill(-process_, SIGKILL);
  if (!ended_) waitpid(process_, nullptr, 0);
  close(output_);
  close(errors_);
}

bool ChildProgram::running() {
  if (!ended_) ended_ = waitpid(process_, nullptr, WNOHANG) == process_;
  return !ended_;
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
  read_on(errors_, error_text_);
  if (error_text_.size() > most_error_text)
    error_text_.erase(0, error_text_.size() - most_error_text);
  return error_text_;
}

}  // namespace hookpoint::cli
