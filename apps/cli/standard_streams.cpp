#include "apps/cli/standard_streams.h"

#include <fcntl.h>
#include <poll.h>
#include <unistd.h>

#include <cerrno>
#include <csignal>
#include <cstdio>
#include <cstring>
#include <iostream>

#include "apps/cli/exit_status.h"
#include "apps/shared/application.h"

namespace hookpoint::cli {
namespace {

/// Why writing fails, by trying again: the error of what came before is lost in a stream's buffer.
/// 0 when it does not fail any more.
int reason_of_failure() { return ::write(STDOUT_FILENO, "\n", 1) < 0 ? errno : 0; }

bool reader_has_gone() {
  pollfd output{STDOUT_FILENO, 0, 0};
  return ::poll(&output, 1, 0) == 1 && (output.revents & POLLERR) != 0;
}

}  // namespace

void take_standard_streams() {
  std::signal(SIGPIPE, SIG_IGN);
  // A write beyond the limit of file sizes then fails as one to a full disk does.
  std::signal(SIGXFSZ, SIG_IGN);
  for (const int descriptor : {STDIN_FILENO, STDOUT_FILENO, STDERR_FILENO}) {
    if (::fcntl(descriptor, F_GETFD) != -1 || errno != EBADF) continue;
    // The lowest free number is this one; what is opened the other way round refuses all use.
    const int way = descriptor == STDIN_FILENO ? O_WRONLY : O_RDONLY;
    if (::open("/dev/null", way) != descriptor) return;
  }
}

int finish_standard_output(int status) {
  std::cout.flush();
  const bool written = std::fflush(stdout) == 0 && std::ferror(stdout) == 0 && std::cout.good();
  if (written) return status;
  if (reader_has_gone()) {
    std::signal(SIGPIPE, SIG_DFL);
    std::raise(SIGPIPE);
  }
  const int reason = reason_of_failure();
  application::print_error(
      "cannot write to standard output" +
      (reason == 0 ? std::string() : std::string(": ") + std::strerror(reason)));
  return status == fine ? missing : status;
}

}  // namespace hookpoint::cli
