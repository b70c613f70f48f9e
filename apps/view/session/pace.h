// How fast simulated time is to pass, and how fast it does.
#pragma once

#include <chrono>
#include <deque>
#include <utility>

namespace hookpoint::view {

class Pace {
 public:
  using Clock = std::chrono::steady_clock;

  /// Of every session: 60 snapshots a second; requests are looked for at least so often; and where
  /// no browser is connected.
  static constexpr std::chrono::microseconds between_snapshots{16'667};
  static constexpr std::chrono::milliseconds slice{5}, idle{100};

  /// Simulated over elapsed time; 0: as fast as possible.
  double requested() const { return requested_; }
  void ask(double factor) {
    requested_ = factor;
    begun_ = false;
  }
  /// The run has stood still, or been put to another moment.
  void restart() {
    begun_ = false;
    passed_.clear();
  }

  /// The simulated time that is due at `now`, of a run that has come to `time` [s]. One that cannot
  /// keep up need not make good what it has lost.
  double due(Clock::time_point now, double time);
  /// When `time` is due [s].
  Clock::time_point when(double time) const;

  /// The run has come to `time` at `now` [s].
  void reach(Clock::time_point now, double time);
  /// Over the last second; 0 of a run that stands.
  double reached() const;

 private:
  double requested_ = 1.;
  bool begun_ = false;
  Clock::time_point start_;
  double start_time_ = 0.;
  std::deque<std::pair<Clock::time_point, double>> passed_;
};

}  // namespace hookpoint::view
