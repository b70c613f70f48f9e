// A movie's moments, one at a time: a world that is brought to a step piece by piece, exactly as
// the run had it.
#pragma once

#include <chrono>
#include <cstdint>
#include <functional>
#include <memory>
#include <string>
#include <vector>

#include "apps/view/wire/audience.h"
#include "simulation/run/rewind.h"

namespace hookpoint::view {

/// A movie and how its world is made, at time 0. What is referred to outlives who shows it.
struct ShownMovie {
  const simulation::Experiment& experiment;
  const output::MovieReader& reader;
  std::function<std::unique_ptr<simulation::World>()> make_world;
};

class Reel {
 public:
  using Clock = std::chrono::steady_clock;

  /// At the first moment, or on the way there. Throws output::MovieError,
  /// simulation::ExperimentError.
  explicit Reel(const ShownMovie& movie);

  simulation::World& world() { return *world_; }
  std::int64_t first() const { return rewind_->first(); }
  std::int64_t last() const { return rewind_->last(); }
  std::int64_t step() const { return world_->state().step; }
  double time() const { return world_->state().time; }
  /// Grows when the world is another one: who holds ports of it looks them up again.
  std::uint64_t generation() const { return generation_; }

  /// From now on this step is wanted; one out of reach: the nearest that is not.
  void aim(std::int64_t step);
  bool there() const { return step() == goal_ && rewind_->whole(); }
  /// Whether what only a step computes is right, here where it is.
  bool whole() const { return rewind_->whole(); }
  /// One step towards the wanted one. Throws output::MovieError when none leads on.
  void go_on();
  /// Towards the wanted step for so long; whether it is there.
  bool go(Clock::time_point until);
  /// Where the run first did not repeat the movie, "" while it does.
  const std::string& difference() const { return difference_; }

  /// The present moment, which it writes into `state`; valid until the world moves.
  SubjectState moment(SessionState& state);
  /// The present moment, to all viewers. `state`: all but the moment.
  void publish(Audience& audience, SessionState state);

 private:
  void begin();

  const ShownMovie movie_;
  std::unique_ptr<simulation::World> world_;
  std::unique_ptr<simulation::Rewind> rewind_;
  std::int64_t goal_ = 0;
  std::uint64_t generation_ = 0;
  std::string difference_;
  std::vector<simulation::Pose> poses_;
  std::vector<simulation::ContactView> contacts_;
};

}  // namespace hookpoint::view
