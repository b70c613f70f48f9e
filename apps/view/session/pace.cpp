#include "apps/view/session/pace.h"

namespace hookpoint::view {
namespace {

double seconds(Pace::Clock::duration duration) {
  return std::chrono::duration<double>(duration).count();
}

}  // namespace

double Pace::due(Clock::time_point now, double time) {
  constexpr double most_behind = 0.1;  // of elapsed time [s]
  if (begun_) {
    const double due = start_time_ + requested_ * seconds(now - start_);
    if (due - time <= most_behind * requested_) return due;
  }
  begun_ = true;
  start_ = now;
  start_time_ = time;
  return time;
}

Pace::Clock::time_point Pace::when(double time) const {
  const std::chrono::duration<double> after((time - start_time_) / requested_);
  return start_ + std::chrono::duration_cast<Clock::duration>(after);
}

void Pace::reach(Clock::time_point now, double time) {
  passed_.emplace_back(now, time);
  while (passed_.size() > 2 && seconds(now - passed_.front().first) > 1.) passed_.pop_front();
}

double Pace::reached() const {
  if (passed_.size() < 2) return 0.;
  const double elapsed = seconds(passed_.back().first - passed_.front().first);
  return elapsed > 0. ? (passed_.back().second - passed_.front().second) / elapsed : 0.;
}

}  // namespace hookpoint::view
