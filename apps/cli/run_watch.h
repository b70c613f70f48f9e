// Looks at a run from beside it: shows how far its time has come, and ends it when the user wants
// it ended, even within a step that does not return.
#pragma once

#include <atomic>
#include <functional>
#include <mutex>
#include <optional>
#include <string>
#include <thread>

#include "apps/cli/interrupt.h"

namespace hookpoint::cli {

/// From `first` to `last` [s], simulated time.
struct RunSpan {
  double first = 0., last = 0.;
};

class RunWatch {
 public:
  /// `close` completes the run's files as they are after the last row. It is called, in another
  /// thread, only when the user has interrupted the run and its step takes a second more; the
  /// program then ends with the status of an interrupt.
  RunWatch(std::string label, RunSpan span, std::function<void()> close);
  ~RunWatch();
  RunWatch(const RunWatch&) = delete;
  RunWatch& operator=(const RunWatch&) = delete;

  /// Whether the run is to end here.
  bool stopped() const { return guard_.stop().load(std::memory_order_relaxed); }
  /// The exit status of a run that was stopped.
  int status() const { return guard_.status(); }

  /// Around each step: nothing but the engine and its signals work between the two. False, and no
  /// step, once the run is to end. `time`: reached [s].
  bool begin_step() {
    if (stopped()) return false;
    phase_.store(Phase::stepping, std::memory_order_release);
    return true;
  }
  void end_step(double time) {
    if (phase_.exchange(Phase::between, std::memory_order_acquire) == Phase::taken) wait_for_end();
    time_.store(time, std::memory_order_relaxed);
  }

  /// A line on stderr, above the bar.
  void say(const std::string& line);

 private:
  using Clock = std::chrono::steady_clock;
  enum class Phase { between, stepping, taken };

  void watch();
  void draw();
  void end_within_step();
  [[noreturn]] static void wait_for_end();

  InterruptGuard guard_;
  const std::string label_;
  const RunSpan span_;
  const std::function<void()> close_;
  const bool terminal_;
  const Clock::time_point start_ = Clock::now();
  std::atomic<Phase> phase_{Phase::between};
  std::atomic<double> time_;
  std::atomic<bool> done_{false};
  std::mutex line_;  ///< whoever writes to stderr
  bool drawn_ = false;
  std::thread thread_;
};

}  // namespace hookpoint::cli
