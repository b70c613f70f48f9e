// Loops of the robots' links as ODE's balls and hinges.
#pragma once

#include <deque>
#include <span>
#include <vector>

#include "reference/ode/library.h"
#include "reference/robot_tree.h"

namespace hookpoint::reference {

class OdeLoops {
 public:
  /// `bodies` as in OdeJoints.
  OdeLoops(const simulation::Experiment& experiment, const RobotTree& tree, dWorldID world,
           const std::vector<dBodyID>& bodies);

  /// Forces and moments of the last step, on body a at its place.
  void read(std::span<simulation::LoopState> loops) const;

 private:
  struct Loop {
    dJointID id;   ///< owned by the world
    dBodyID a, b;  ///< null: a base that nothing moves
    Vector3d
        lever;  ///< from the centre of mass of that of a and b which moves, to the place, its axes
  };
  std::vector<Loop> loops_;
  std::deque<dJointFeedback> feedback_;  ///< of each; ODE keeps its address
};

}  // namespace hookpoint::reference
