#include "apps/cli/interrupt.h"

#include <semaphore.h>
#include <unistd.h>

#include <cerrno>
#include <csignal>
#include <ctime>

namespace hookpoint::cli {
namespace {

std::atomic<bool> stop_requested{false};
std::atomic<int> signal_received{0};
static_assert(std::atomic<bool>::is_always_lock_free && std::atomic<int>::is_always_lock_free,
              "set from a signal handler");
sem_t woken;

int status_of(int signal) { return 128 + signal; }

void request_stop(int signal) {
  // The number comes before the flag: who sees the flag asks for the status.
  int none = 0;
  if (!signal_received.compare_exchange_strong(none, signal)) _exit(status_of(signal));
  stop_requested = true;
  const int saved = errno;
  sem_post(&woken);
  errno = saved;
}

/// A signal that the program was told to ignore, as in the background of a script, stays ignored.
void handle(void (*handler)(int)) {
  struct sigaction action {};
  action.sa_handler = handler;
  action.sa_flags = SA_RESTART;
  for (const int signal : {SIGINT, SIGTERM, SIGHUP}) {
    struct sigaction before {};
    sigaction(signal, nullptr, &before);
    if (before.sa_handler != SIG_IGN) sigaction(signal, &action, nullptr);
  }
}

}  // namespace

InterruptGuard::InterruptGuard() {
  stop_requested = false;
  signal_received = 0;
  sem_init(&woken, 0, 0);
  handle(request_stop);
}

InterruptGuard::~InterruptGuard() {
  handle(SIG_DFL);
  sem_destroy(&woken);
}

const std::atomic<bool>& InterruptGuard::stop() const { return stop_requested; }

int InterruptGuard::status() const { return status_of(signal_received); }

void InterruptGuard::wait() const {
  while (sem_wait(&woken) != 0 && errno == EINTR) {
  }
}

void InterruptGuard::wait_for(std::chrono::milliseconds time) const {
  timespec until{};
  clock_gettime(CLOCK_MONOTONIC, &until);
  const long nanoseconds = until.tv_nsec + time.count() % 1000 * 1'000'000;
  until.tv_sec += time.count() / 1000 + nanoseconds / 1'000'000'000;
  until.tv_nsec = nanoseconds % 1'000'000'000;
  while (sem_clockwait(&woken, CLOCK_MONOTONIC, &until) != 0 && errno == EINTR) {
  }
}

void InterruptGuard::interrupt() const {
  if (!stop_requested) request_stop(SIGINT);
}

void InterruptGuard::wake() const { sem_post(&woken); }

}  // namespace hookpoint::cli
