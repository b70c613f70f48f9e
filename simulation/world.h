// A run: an engine and the signals around it, step by step. The same for every engine.
#pragma once

#include <memory>
#include <string>

#include "simulation/signals.h"

namespace hookpoint::simulation {

class World {
 public:
  /// At time 0, all signals evaluated: the first row of a record can be read. `experiment` outlives
  /// the world. Throws ExperimentError.
  World(const Experiment& experiment, std::unique_ptr<Engine> engine);

  /// From the present row to the next: the engine steps under the present inputs, then the signals
  /// follow its new state. Between two steps every port holds what is visible at `state().time`.
  /// While `World.running` is false nothing moves. Allocates nothing.
  StepStatus step();

  const WorldState& state() const { return engine_->state(); }
  /// Every port of the run. O(ports).
  std::vector<Port> ports() { return signals_.ports(); }
  /// Why a run without windows ends here, or "" while it goes on: `Simulator.quit` is true, or
  /// `World.running` is false, which nothing can change any more once time stands still.
  std::string ended() const;

 private:
  std::unique_ptr<Engine> engine_;
  Signals signals_;
};

}  // namespace hookpoint::simulation
