// Where nothing drives a world, its mechanical energy cannot grow. If it does, the step is too
// large for what moves, or a contact has crossed an edge of the ground where its depth jumps.
// Watched at some instants of a run, at no cost to the others.
#pragma once

#include <cstdint>
#include <string>
#include <string_view>
#include <vector>

#include "simulation/run/world.h"

namespace hookpoint::simulation {

/// Whether nothing drives the experiment but ground and obstacles that move, whose work is counted: no
/// wire ends at a joint, a Force or gravity, and no Force acts over a window or by a moment. A wire
/// that ends at a component, wherever that stands, drives nothing by itself. What is
/// constant has a potential: gravity, forces, torques of joints.
bool is_passive(const Experiment& experiment);

/// T + V of all that moves [J]: kinetic energy, weights, Forces, springs and constant torques of
/// joints, stops, and what the ground holds, less the work of ground and obstacles that move. Nothing is said of a world that is driven, or whose
/// engine does not tell what its ground holds. What joints' dry friction holds is not published:
/// the most that it can hold counts as no rise. From published values. O(bodies + boundary points).
class EnergyWatch {
 public:
  /// Steps below which nothing is said.
  static constexpr std::int64_t fewest_steps = 200;
  /// Of a run from the world's present step to step `last`.
  EnergyWatch(const Experiment& experiment, const World& world, std::int64_t last);

  /// After each step; looks at one in many.
  void observe() {
    if (stride_ > 0 && world_.state().step % stride_ == 0) sample();
  }

  /// "its energy rose by 0.1 J ...", or "" where it did not. Compares the greatest energy in
  /// twentieths of the run: between its extremes a vibration's energy wavers with the step.
  std::string finding() const;

 private:
  struct Sample {
    double time = 0.;                  ///< [s]
    double kinetic = 0., energy = 0.;  ///< the part that is kinetic, and the whole [J]
    bool jumped = false;               ///< as `jumps` says
  };
  /// The deepest contact of a body.
  struct Touch {
    double depth = 0.;  ///< [m]; 0 where there is none
    double speed = 0.;  ///< that any of its contacts can have [m/s]
  };
  void sample();
  /// Whether some body is deeper in the ground than it can have moved since the last sample,
  /// `interval` [s] ago: the ground under it has jumped.
  bool jumps(double interval);

  const Experiment& experiment_;
  const World& world_;
  std::int64_t stride_ = 0;  ///< steps from one look to the next; 0: nothing is said
  bool surfaces_move_ = false;
  double most_in_friction_ = 0.;           ///< that springs of joints' dry friction can hold [J]
  std::vector<std::size_t> first_bodies_;  ///< of each robot, in WorldState::bodies
  std::vector<Sample> samples_;
  std::vector<Touch> touches_, touches_before_;  ///< of each body
  std::vector<ContactView> contacts_;
};

/// With which every finding begins.
inline constexpr std::string_view energy_finding = "nothing drives it, yet its energy rose";

}  // namespace hookpoint::simulation
