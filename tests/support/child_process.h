// The program beside the test: signals reach it at known moments of its work, never after a time.
#pragma once

#include <fcntl.h>
#include <signal.h>
#include <sys/prctl.h>
#include <sys/wait.h>
#include <unistd.h>

#include <chrono>
#include <filesystem>
#include <fstream>
#include <functional>
#include <iterator>
#include <string>
#include <thread>
#include <vector>

#include "tests/support/folders.h"
#include "tests/support/text.h"

namespace hookpoint::testing {

class ChildProcess {
 public:
  /// `hookpoint WORDS` in `folder`, its streams in .out and .err there, in a process group of its
  /// own. It is told to ignore `ignored`, and no other signal, whatever the test itself ignores.
  ChildProcess(const std::filesystem::path& folder, std::vector<std::string> words,
               const std::vector<int>& ignored = {})
      : folder_(folder) {
    words.insert(words.begin(), testing::build_folder() + "/hookpoint");
    std::vector<char*> arguments;
    for (std::string& word : words) arguments.push_back(word.data());
    arguments.push_back(nullptr);
    const std::string out = folder / ".out", err = folder / ".err";
    for (const std::string& stream : {out, err}) std::filesystem::remove(stream);
    process_ = fork();
    // Here and there: whichever comes first.
    setpgid(process_, process_);
    if (process_ != 0) return;
    prctl(PR_SET_PDEATHSIG, SIGKILL);
    for (const int number : {SIGINT, SIGTERM, SIGHUP, SIGXFSZ}) ::signal(number, SIG_DFL);
    for (const int number : ignored) ::signal(number, SIG_IGN);
    if (chdir(folder.c_str()) != 0) _exit(126);
    dup2(open(out.c_str(), O_WRONLY | O_CREAT | O_TRUNC, 0600), STDOUT_FILENO);
    dup2(open(err.c_str(), O_WRONLY | O_CREAT | O_TRUNC, 0600), STDERR_FILENO);
    execv(arguments.front(), arguments.data());
    _exit(127);
  }
  ~ChildProcess() {
    if (process_ <= 0) return;
    signal(SIGKILL);
    wait();
  }
  ChildProcess(const ChildProcess&) = delete;
  ChildProcess& operator=(const ChildProcess&) = delete;

  /// To it and what it has started; nothing once it has ended.
  void signal(int number) const {
    if (process_ > 0) kill(-process_, number);
  }
  /// What it has started itself, and what of it has not ended.
  std::vector<pid_t> children() const {
    std::vector<pid_t> found;
    std::error_code ended;
    const std::string threads = "/proc/" + std::to_string(process_) + "/task";
    for (std::filesystem::directory_iterator thread(threads, ended), end; !ended && thread != end;
         thread.increment(ended)) {
      std::ifstream list(thread->path() / "children");
      found.insert(found.end(), std::istream_iterator<pid_t>(list), {});
    }
    return found;
  }
  std::string out() const { return read_file(folder_ / ".out"); }
  std::string err() const { return read_file(folder_ / ".err"); }
  /// Waits for as long as it takes until `reached`; false when the program has ended before.
  bool wait_until(const std::function<bool()>& reached) {
    while (!reached()) {
      if (ended()) return reached();
      std::this_thread::sleep_for(std::chrono::milliseconds(2));
    }
    return true;
  }
  /// Its exit status; 1000 and the signal's number when a signal has ended it.
  int wait() {
    if (process_ > 0) take(waitpid(process_, &raw_, 0));
    return WIFEXITED(raw_) ? WEXITSTATUS(raw_) : 1000 + WTERMSIG(raw_);
  }

 private:
  bool ended() {
    if (process_ > 0) take(waitpid(process_, &raw_, WNOHANG));
    return process_ <= 0;
  }
  void take(pid_t found) {
    if (found == process_) process_ = 0;
  }

  std::filesystem::path folder_;
  pid_t process_ = 0;
  int raw_ = 0;
};

}  // namespace hookpoint::testing
