// Back to time 0, also from other positions and velocities than the file's.
#pragma once

namespace hookpoint::simulation {

struct Experiment;
struct WorldInputs;

/// An engine that can start again. What it publishes keeps its addresses.
class Restartable {
 public:
  virtual ~Restartable() = default;
  /// The state at time 0 of a new engine of `start`, which is the engine's own experiment except
  /// for the robots' initial positions and velocities: no contact has a memory, inputs are the
  /// file's. Throws ExperimentError and changes nothing where a library refuses that state.
  virtual void restart(const Experiment& start) = 0;
};

/// Sets `inputs` to initial_inputs(start) without a change of their addresses.
void restart_inputs(const Experiment& start, WorldInputs& inputs);

}  // namespace hookpoint::simulation
