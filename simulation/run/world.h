// A run: an engine and the signals around it, step by step. The same for every engine.
#pragma once

#include <cstdint>
#include <memory>
#include <span>
#include <string>
#include <vector>

#include "simulation/wiring/signals.h"

namespace hookpoint::simulation {

class World {
 public:
  /// At time 0, all signals evaluated: the first row of a record can be read. `experiment` outlives
  /// the world. Throws ExperimentError.
  World(const Experiment& experiment, std::unique_ptr<Engine> engine);

  /// From the present row to the next: the engine steps under the present inputs, then the signals
  /// follow its new state. Between two steps every port holds what is visible at `state().time`.
  /// While `World.running` is false nothing moves. Allocates nothing. A signal that is no longer
  /// finite stops the run as a state does, at the instant at which it is seen, time 0 included.
  StepStatus step();

  /// Nobody sets an input between the next `steps` calls of step(): an engine that is a program may
  /// then answer for several at once. Where a wire or a window of time drives an input it does not.
  void announce(std::int64_t steps);

  const WorldState& state() const { return engine_->state(); }
  /// What the ground's springs hold, where the engine tells [J].
  std::optional<double> ground_energy() const { return engine_->ground_energy(); }
  /// What touches the ground (Engine::tell_contacts).
  void tell_contacts(std::vector<ContactView>& contacts) const { engine_->tell_contacts(contacts); }
  /// What the next step is taken under.
  const WorldInputs& inputs() const { return engine_->inputs(); }
  /// From the next step on the bodies' `contact_force` in `state()` is right, as it is anyway once
  /// somebody reads its port.
  void publish_contact_forces() { engine_->enable_mean_forces(true); }
  /// Numerical energy of the robots, and the work of what drives them; to be begun by who reads it.
  EnergyBalance& energy_balance() { return signals_.energy_balance(); }
  const EnergyBalance& energy_balance() const { return signals_.energy_balance(); }
  /// Every port of the run. O(ports).
  std::vector<Port> ports() { return signals_.ports(); }
  /// Every port that may be set between two steps. O(ports).
  std::vector<Port> settable() { return signals_.settable(); }
  /// The port of that trail, where it is one that may be written. O(ports).
  std::optional<Port> input(std::string_view trail) { return signals_.input(trail); }
  /// The ports that `values` may be set to, in order. Throws ExperimentError for one that nobody
  /// may write, that a wire writes, or whose number is not finite or out of its range. O(ports).
  std::vector<Port> settable(std::span<const PortValue> values);
  /// Sets one of those between two steps. What only copies it has it at once, while `World.running`
  /// is false too; a wire with a rate, a delay or noise takes it at its next sample.
  void set(const Port& port, double value);
  /// The same for numbers that were written to their ports: to be called before the next step.
  /// Allocates nothing.
  void follow() { signals_.follow(); }
  /// Whether each wire that starts there has sampled the port's value in a step after `step`.
  bool sampled_after(std::int64_t step, const Port& port) const {
    return signals_.sampled_after(step, port.value);
  }
  /// The experiment with the values that its components have at this moment, which sliders may have
  /// moved.
  Experiment as_it_stands() const;
  /// `World.running` and `Simulator.quit`.
  bool running() const { return signals_.running(); }
  bool quit() const { return signals_.quit(); }
  /// Why a run without windows ends here, or "" while it continues: `Simulator.quit` is true, or
  /// `World.running` is false, which nothing can change any more once time stands still.
  std::string ended() const;

  /// Everything that evolves, as numbers: a world of the same experiment that restores them
  /// continues bit for bit as this one does. Ports that describe the step that led to an instant (joints'
  /// acceleration, total_torque and reactions, bodies' accelerations, hip forces) are right again after the
  /// next step. Throws ExperimentError when the engine cannot be saved.
  std::vector<StateSection> state_layout() const;
  bool can_be_saved() const { return engine_->resumable() != nullptr; }
  std::size_t state_size() const;
  /// `numbers`: state_size() of them. Allocates nothing.
  void save(std::span<double> numbers) const;
  void restore(std::span<const double> numbers);

  /// What a movie keeps of an instant: the same, or of an engine that cannot be saved what it publishes.
  std::vector<StateSection> instant_layout() const;
  std::size_t instant_size() const;
  /// `numbers`: instant_size() of them. Allocates nothing.
  void save_instant(std::span<double> numbers) const;

  /// Back to time 0, whatever the engine: all is as in a new world of `start`, which is the world's
  /// experiment except for the robots' initial positions and velocities (initial_state.h). Ports
  /// keep their addresses; those of the step that led to an instant are right after the next step,
  /// as after restore(). Throws ExperimentError and changes nothing where the engine refuses that
  /// state. Costs about as much as a new world.
  void restart(const Experiment& start);

 private:
  Resumable& resumable() const;
  std::vector<StateSection> layout_of(const Saveable& engine) const;
  void save(const Saveable& engine, std::span<double> numbers) const;
  /// Brings `signals` to the engine's present state. False where a number is no longer finite.
  bool update(Signals& signals) const;
  /// Why the run cannot continue where a number is not finite.
  StepStatus status_of_signals(bool finite);

  const Experiment& experiment_;
  std::unique_ptr<Engine> engine_;
  Signals signals_;
  StepStatus start_;  ///< of the signals at time 0
};

/// Of a port that is no longer finite.
StepStatus stopped_by_port(double time, const std::string& trail);

}  // namespace hookpoint::simulation
