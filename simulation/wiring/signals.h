// What flows in a run: values from ports along wires, through components, to ports. Built once; a
// step of it allocates nothing and looks nothing up.
#pragma once

#include <cstdint>
#include <vector>

#include "simulation/engine_interface/resumable.h"
#include "simulation/wiring/components.h"
#include "simulation/wiring/derived_ports.h"
#include "simulation/wiring/ports.h"
#include "simulation/wiring/pull.h"
#include "simulation/wiring/timing.h"
#include "simulation/wiring/wiring_order.h"

namespace hookpoint::simulation {

class Signals {
 public:
  /// Resolves every wire of `experiment` to the ports of `engine` and the components, and starts
  /// the components. Both outlive it. Throws ExperimentError, which a loaded experiment never
  /// causes.
  Signals(const Experiment& experiment, Engine& engine);

  /// Before the engine steps, under the inputs that it steps with.
  void begin_step() { derived_.balance().begin_step(); }
  EnergyBalance& energy_balance() { return derived_.balance(); }
  const EnergyBalance& energy_balance() const { return derived_.balance(); }

  // The parts of an update at `step` (World::step has their order): of every step once, from 0 on,
  // when the engine has the state of that step. Allocate nothing.

  /// Ports that are computed from the engine's new state.
  void sense(std::int64_t step);
  /// Samples that were under way arrive.
  void deliver(std::int64_t step);
  /// Components that are due update, and wires without delay carry values, each after what it takes
  /// from.
  void propagate(std::int64_t step);
  /// Wires with delay sample.
  void sample(std::int64_t step);
  /// Forces reach the engine, a `Push` times its envelope; drives are there already.
  void actuate(std::int64_t step);
  /// False where a number that a wire delivers, a component puts out or a derived port has worked
  /// out is no longer finite.
  bool finite() const;

  /// The trail of the first port that is not finite, "" if there is none. O(ports), allocates.
  std::string first_not_finite();

  /// `World.running` and `Simulator.quit` as wires have left them.
  bool running() const { return held_.running != 0.; }
  bool quit() const { return held_.quit != 0.; }
  /// Every port, of the engine too. O(ports), allocates.
  std::vector<Port> ports();
  /// Every port that somebody may set between two steps. O(ports), allocates.
  std::vector<Port> settable();
  /// The port of that trail, where it is one that may be written. O(ports).
  std::optional<Port> input(std::string_view trail);
  /// The number that somebody may set by `trail` between two steps. Throws ExperimentError for one
  /// that nobody may write, or that a wire writes. O(ports).
  Port settable(std::string_view trail);
  /// After numbers were set between two steps: what only copies them has them too, and what acts
  /// from outside follows. However often it is called, the values are the same. Allocates nothing.
  void follow();
  /// The components as `specs` have them, with the numbers that they hold now. Allocates.
  std::vector<ComponentSpec> as_held(std::vector<ComponentSpec> specs) const;
  /// Whether each wire that starts at `value` has sampled it in a step after `step`.
  bool sampled_after(std::int64_t step, const double* value) const;

  /// What evolves beside the engine's own state, in stretches of one owner each.
  std::vector<StateSection> state_layout() const;
  std::size_t state_size() const;
  /// `numbers`: state_size() of them, at the engine's present step. Allocates nothing.
  void save(std::span<double> numbers) const;
  /// The engine has its state of that step already.
  void restore(std::span<const double> numbers);

 private:
  template <class Self, class Archive>
  static void exchange(Self& self, Archive& archive);
  struct Line {
    const double* from;
    double* to;
    bool copies;  ///< nothing happens to a value on its way
    control::TransmissionLine line;
    bool starts_at_input;  ///< at a number that may be written, as its end is
  };
  struct Updates {
    control::Schedule schedule;
    std::int64_t count = 0;  ///< updates so far
    double last = 0.;        ///< time of the last [s]
  };
  /// What is neither the engine's nor a component's. Sized once: its addresses last.
  struct HeldPorts {
    double step = 0., impacts = 0., running = 1., quit = 0.;
    std::vector<ForceInput> forces;  ///< as written or wired, before their windows
    std::vector<double> envelopes;   ///< one a force: the part of it that acts
    std::vector<double> values;      ///< one a ValueSpec
  };

  void connect(const std::vector<Port>& ports);
  void find_held_lines();
  void update_component(std::size_t index, std::int64_t step, double time);
  void watch_values();
  void add_held_ports(std::vector<Port>& ports);
  void add_component_ports(std::vector<Port>& ports);

  const Experiment& experiment_;
  Engine& engine_;
  DerivedPorts derived_;
  Components components_;
  HeldPorts held_;
  Pull pull_;
  std::vector<Updates> updates_;         // one a component
  std::vector<Line> lines_;              // one a wire
  std::vector<std::size_t> delayed_;     // lines whose samples arrive in a later step
  std::vector<WiringItem> order_;        // the other lines and the components
  std::vector<std::size_t> held_lines_;  // those that copy what only users change, in that order
  std::vector<Port> all_ports_;          // once somebody has set something
  std::vector<const double*> watched_;   // ends of lines, outputs of components
};

}  // namespace hookpoint::simulation
