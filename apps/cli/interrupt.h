// What the interrupt key, SIGTERM and SIGHUP do while a run or a study is at work.
#pragma once

#include <atomic>
#include <chrono>

namespace hookpoint::cli {

/// While it lives, the interrupt key (SIGINT), SIGTERM and SIGHUP (the terminal closes) set
/// `stop()` instead of ending the program; a second one ends it at once, with the exit status of an
/// interrupt. One that was ignored before, as nohup does, stays ignored. One guard at a time.
class InterruptGuard {
 public:
  InterruptGuard();
  ~InterruptGuard();
  InterruptGuard(const InterruptGuard&) = delete;
  InterruptGuard& operator=(const InterruptGuard&) = delete;

  const std::atomic<bool>& stop() const;
  /// 128 and the number of the signal that came: 130 after the interrupt key, 143 after SIGTERM,
  /// 129 after SIGHUP.
  int status() const;
  /// Waits for a signal, `wake` or the time to pass. One thread at a time.
  void wait() const;
  void wait_for(std::chrono::milliseconds time) const;
  /// As the interrupt key does, once.
  void interrupt() const;
  /// Ends a wait.
  void wake() const;
};

}  // namespace hookpoint::cli
