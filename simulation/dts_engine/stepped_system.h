// A system that step() leads from one accepted state to the next.
#pragma once

#include <span>
#include <string>

#include "integrators/hybrid_system.h"

namespace hookpoint::simulation {

class SteppedSystem : public integrators::HybridSystem {
 public:
  // The parts of a step (step.h), in their order.

  /// The forces of the present inputs take the place of those that the state was refreshed with;
  /// contact does not depend on them.
  virtual void take_inputs() = 0;
  /// Where a step of `dt` [s] from `time` [s] starts: q and v as the integrator moves them, and
  /// remembered for `undo`.
  virtual void begin_step(double time, double dt) = 0;
  /// The present state is accepted: what it has made of hooks, bristles and dry friction is what
  /// every force of the step is computed from.
  virtual void commit_memory() = 0;
  virtual std::span<double> positions() = 0;
  virtual std::span<double> velocities() = 0;
  /// Goes to where the integrator has brought q and v.
  virtual void finish_step() = 0;
  /// Back to where the last step began.
  virtual void undo() = 0;

  /// Length of a step of the experiment [s].
  virtual double deltat() const = 0;
  /// The body that a failure is reported of: "block.base".
  virtual std::string trail() const = 0;
};

}  // namespace hookpoint::simulation
