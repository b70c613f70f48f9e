// Whether a run has gained energy that nothing put in: its step is too large for what moves, or a contact
// has crossed an edge of the ground where its depth jumps. Two accounts are watched:
//  - where the engine tells what its ground holds, T + V of all that moves, springs and ground
//    included, less the work of drives, Forces and ground in motion, which cannot grow;
//  - where the run measures it for somebody, the numerical energy of each robot (docs/integrators.md),
//    whose drift is the integration's, even where friction and dampers hide it.
// Looked at in some instants of a run; between them the work of drives alone is summed.
#pragma once

#include <cstdint>
#include <optional>
#include <span>
#include <string>
#include <string_view>
#include <vector>

#include "simulation/engine_interface/moving_energy.h"
#include "simulation/run/world.h"

namespace hookpoint::simulation {

/// What joints' dry friction holds is not published: the most that it can hold counts as no rise.
class EnergyWatch {
 public:
  /// Steps below which nothing is said.
  static constexpr std::int64_t fewest_steps = 200;
  /// Of a run from the world's present step to step `last`.
  EnergyWatch(const Experiment& experiment, World& world, std::int64_t last);

  /// After each step; looks at one in many. O(bodies + boundary points) where it looks.
  void observe() {
    if (stride_ == 0) return;
    if (unpaired_) pair();
    if (world_.state().step % stride_ == 0) sample();
  }

  /// "its energy rose by more than was put in ...", or "" where it did not. Compares twentieths of the
  /// run: between its extremes a vibration's energy wavers with the step.
  std::string finding() const;

 private:
  struct Sample {
    double time = 0.;     ///< [s]
    double size = 0.;     ///< of the energies that it is made of [J]
    double energy = 0.;   ///< that cannot grow [J]
    double plain = 0.;    ///< the same with T of the new velocities [J]
    bool jumped = false;  ///< as `jumps` says
  };
  /// The deepest contact of a body.
  struct Touch {
    double depth = 0.;  ///< [m]; 0 where there is none
    double speed = 0.;  ///< that any of its contacts can have [m/s]
  };
  /// By how much an account rose, and from when to when.
  struct Rise {
    double energy = 0., from = 0., to = 0., begin = 0.;
  };
  /// A sample of an integrator whose positions move with new velocities: those of the sample are then
  /// of half a step before its positions, and its energy is complete a step later.
  struct Unpaired {
    Sample sample;
    std::int64_t step = 0;
    double kinetic_energy = 0.;  ///< [J]
  };
  void sample();
  /// Completes the sample of the step before: takes v_n . M v_{n+1}/2 for its kinetic energy, with which
  /// a step of semi-implicit Euler keeps the energy of linear springs exactly.
  void pair();
  double kinetic_energy(std::span<const BodyState> bodies,
                        std::span<const JointState> joints) const;
  /// Whether some body is deeper in the ground than it can have moved since the last sample,
  /// `interval` [s] ago: the ground under it has jumped.
  bool jumps(double interval);
  /// The sample after the last one of a window.
  std::size_t end_of(std::size_t window) const;
  template <class Window>
  Rise greatest_rise(const Window& window) const;
  Rise rise_of_all() const;
  /// The rise of plain energy to a window whose least is above the greatest of an earlier one by more than
  /// a vibration wavers: what a step that is not stable gains, which v_n . M v_{n+1}/2 hides.
  Rise lasting_rise() const;
  Rise rise_of(std::size_t robot) const;
  /// What takes part in the motion of a robot, and what drives have put in [J].
  double part_of(std::size_t robot) const;
  double rounding() const;
  bool blames_edges(const Rise& rise) const;

  const Experiment& experiment_;
  World& world_;
  std::int64_t stride_ = 0;  ///< steps from one look to the next; 0: nothing is said
  bool ground_known_ =
      false;               ///< the engine tells what it takes to know the energy that cannot grow
  bool measured_ = false;  ///< somebody has numerical energy measured
  double most_in_friction_ = 0.;       ///< that springs of joints' dry friction can hold [J]
  std::vector<double> driven_before_;  ///< work of drives on each robot when the watch began [J]
  std::vector<MovingEnergy> moving_;   ///< of each robot
  std::vector<Sample> samples_;
  bool new_velocities_ = false;  ///< positions move with new velocities
  std::optional<Unpaired> unpaired_;
  std::vector<BodyState> bodies_;                ///< of the unpaired sample
  std::vector<JointState> joints_;               ///< likewise
  std::vector<std::vector<double>> numerical_;   ///< energies of each robot, one a sample [J]
  std::vector<Touch> touches_, touches_before_;  ///< of each body
  std::vector<ContactView> contacts_;
};

/// With which every finding begins.
inline constexpr std::string_view energy_finding = "its energy rose by more than was put in";

}  // namespace hookpoint::simulation
