// Joints of the robots' links as ODE's hinges and sliders. ODE's bodies have their origin at the
// centre of mass and the axes of the link.
#pragma once

#include <vector>

#include "reference/ode/library.h"
#include "reference/robot_tree.h"

namespace hookpoint::reference {

class OdeJoints {
 public:
  /// `bodies`: one a body of the tree, at its initial pose; null for a base that nothing moves.
  OdeJoints(const RobotTree& tree, dWorldID world, const std::vector<dBodyID>& bodies);

  /// `torques`: one a joint, [N m, N].
  void apply(const std::vector<double>& torques) const;
  /// Angles and rates by the published motion of the bodies. `joints` comes with the angles of the
  /// last step, from which those of turning joints go on.
  void read(std::span<const simulation::BodyState> bodies,
            std::span<simulation::JointState> joints) const;

 private:
  struct Joint {
    dJointID id;  ///< owned by the world
    std::size_t body, parent;
    bool turns;
    simulation::Pose X_PL0;
  };
  std::vector<Joint> joints_;
};

}  // namespace hookpoint::reference
