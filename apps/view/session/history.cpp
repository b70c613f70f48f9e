#include "apps/view/session/history.h"

#include <algorithm>
#include <utility>

namespace hookpoint::view {

History::History(std::int64_t stride, std::size_t most, std::size_t most_bytes)
    : stride_(std::max<std::int64_t>(stride, 1)), most_(most), most_bytes_(most_bytes) {}

void History::keep(const simulation::LiveRun& run, const Tally& tally) {
  Kept kept;
  const std::size_t one =
      moments_.empty() ? 0 : sizeof(Kept) + sizeof(double) * moments_.back().moment.numbers.size();
  const bool full = moments_.size() >= most_ || (moments_.size() + 1) * one > most_bytes_;
  if (moments_.size() > 1 && full) {
    kept = std::move(moments_.front());
    moments_.pop_front();
  }
  run.save(kept.moment);
  kept.tally = tally;
  moments_.push_back(std::move(kept));
}

void History::cut(std::int64_t step) {
  while (!moments_.empty() && moments_.back().step() > step) moments_.pop_back();
}

const History::Kept* History::before(std::int64_t step) const {
  const auto at = std::ranges::lower_bound(moments_, step, {}, &Kept::step);
  if (at != moments_.begin()) return &*std::prev(at);
  return at != moments_.end() && at->step() == 0 && step == 0 ? &*at : nullptr;
}

}  // namespace hookpoint::view
