// What gravity and velocities take of each joint, from what every engine publishes: the joints'
// part of h in M v' + h = S tau + J^T f (docs/dynamics.md).
#pragma once

#include <span>
#include <vector>

#include "simulation/engine_interface/engine.h"
#include "simulation/experiment/experiment.h"

namespace hookpoint::simulation {

/// Of one joint [N m, or N where it slides].
struct JointBiasValues {
  double gravity = 0.;  ///< of h what is there at rest: -m J_c^T g
  double all = 0.;      ///< of h, velocities included
};

class JointBias {
 public:
  /// Allocates; `compute` does not. The experiment outlives it.
  explicit JointBias(const Experiment& experiment);

  /// Sets `values()` for the state: the bodies' accelerations at v' = 0 outwards, then forces
  /// inwards (recursive Newton-Euler, Featherstone 2008, section 5.3), in world axes. O(links).
  void compute(const WorldState& state);
  /// One a joint, as published.
  std::span<const JointBiasValues> values() const { return values_; }

 private:
  /// A force and its moment about the world's origin.
  struct Load {
    Vector3d force, moment;
  };
  struct Body {
    Vector3d acceleration, angular_acceleration;  ///< at v' = 0, of its origin
    Load gravity, all;                            ///< of it and what it carries, on what carries it
    Vector3d axis;                                ///< of its joint
    std::size_t carrier = 0;                      ///< the body that carries it
    bool turns = true;                            ///< its joint does not slide
  };

  void compute_robot(const RobotSpec& robot, std::size_t first_body, std::size_t first_joint,
                     const WorldState& state);

  const Experiment& experiment_;
  std::vector<Body> bodies_;  ///< of one robot at a time
  std::vector<JointBiasValues> values_;
};

}  // namespace hookpoint::simulation
