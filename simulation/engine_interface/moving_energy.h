// The energy that takes part in a robot's motion: what moves to and fro between its coordinates, its
// weights and its springs. A wheel's that turns steadily does not, nor that of a steady glide.
#pragma once

#include <vector>

#include "simulation/engine_interface/engine.h"

namespace hookpoint::simulation {

/// Half the sum over the parts of the energy of the greatest less the least value that each has had: what
/// leaves one part comes to another. Parts are, of each body that moves, m v_i^2/2 along the world's axes and w_i (I w)_i/2 about its own; of each
/// rotor I_r q'^2/2; of each joint k z^2/2; and the weights together.
class MovingEnergy {
 public:
  /// Of robot `index`. The experiment outlives it. Allocates; nothing else does.
  MovingEnergy(const Experiment& experiment, std::size_t index);
  /// O(bodies).
  void observe(const WorldState& state);
  /// Of the states observed so far [J].
  double value() const;

 private:
  struct Part {
    double least = 0., most = 0.;
  };
  void take(std::size_t part, double value);

  const Experiment& experiment_;
  const std::size_t index_;
  std::size_t first_body_ = 0, first_joint_ = 0;  ///< in WorldState
  std::vector<Part> parts_;
  bool begun_ = false;
};

}  // namespace hookpoint::simulation
