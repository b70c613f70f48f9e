// Joint reactions of a robot at its published state.
#pragma once

#include <span>
#include <vector>

#include "dts/joint_reactions.h"
#include "simulation/dts_engine/articulated_robot.h"

namespace hookpoint::simulation {

class Reactions {
 public:
  /// Of `robot`, which outlives it. Allocates; `publish` does not.
  explicit Reactions(const ArticulatedRobot& robot);

  /// One a link, at the robot's present state, under the external forces in its workspace and the joints'
  /// torques there. Solves the forward dynamics once more. O(links).
  void publish(std::span<JointReaction> reactions);

 private:
  const ArticulatedRobot& robot_;
  dts::Workspace<double> workspace_;
  std::vector<double> torques_;
  std::vector<dts::Motion<double>> accelerations_;
  std::vector<dts::Wrench<double>> wrenches_;
};

}  // namespace hookpoint::simulation
