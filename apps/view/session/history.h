// The last minutes of a live run: moments to which it can go back, at even distances.
#pragma once

#include <cstddef>
#include <cstdint>
#include <deque>

#include "apps/view/session/meter.h"
#include "simulation/run/live_run.h"

namespace hookpoint::view {

class History {
 public:
  struct Kept {
    simulation::Moment moment;
    Tally tally;
    std::int64_t step() const { return moment.step; }
  };

  /// `stride`: steps between two moments; `most`: moments that are kept, in at most `most_bytes`.
  /// The oldest go first.
  explicit History(std::int64_t stride, std::size_t most = 15'000,
                   std::size_t most_bytes = std::size_t{256} << 20);

  /// Whether the moment at `step` is to be kept, which must be later than all that are.
  bool due(std::int64_t step) const {
    return step % stride_ == 0 && (moments_.empty() || moments_.back().step() < step);
  }
  /// The present moment of `run`, which has a history.
  void keep(const simulation::LiveRun& run, const Tally& tally);
  /// Forgets what is later than `step`.
  void cut(std::int64_t step);
  void clear() { moments_.clear(); }

  bool empty() const { return moments_.empty(); }
  std::int64_t first() const { return moments_.front().step(); }
  /// The last moment before `step`, or at step 0 that of step 0: a step leads from it, which makes
  /// right what only a step computes. Null where that is forgotten.
  const Kept* before(std::int64_t step) const;

 private:
  std::int64_t stride_;
  std::size_t most_, most_bytes_;
  std::deque<Kept> moments_;
};

}  // namespace hookpoint::view
