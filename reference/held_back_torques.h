// What the drives of a robot hold back at their velocity_limit (simulation/experiment/
// speed_limits.h) where a library finds the accelerations: expected as those of the step before,
// with what the change of the joints' torques makes of them,
//
//   a = (v_k - v_(k-1))/h + J M^-1 S (tau_k - tau_(k-1))
//
// so that weight, contact and loops count as they were a step ago; before the first step they do
// not. Whatever holds the robot makes the true answer to a torque smaller than that of the free
// tree, and the torque at the limit comes to rest: with the part c of it, 0 < c <= 1, errors of the
// rate fall by sqrt(1 - c) a step.
#pragma once

#include <span>
#include <vector>

#include "reference/joint_response.h"
#include "simulation/experiment/speed_limits.h"

namespace hookpoint::reference {

class HeldBackTorques {
 public:
  /// Allocates; nothing else does.
  HeldBackTorques(const simulation::RobotSpec& robot, double step);

  /// Takes from `torques`, of the drives and of what the joints exert by themselves, what the drives
  /// hold back of `drives`. `bodies` and `joints` are the robot's, with the accelerations and torques
  /// of the step before. O(links^3) where a joint has a limit, else O(1).
  void take(std::span<const double> drives, std::span<const simulation::BodyState> bodies,
            std::span<const simulation::JointState> joints, std::span<double> torques);

 private:
  simulation::SpeedLimits limits_;
  JointResponse response_;
  std::vector<double> rates_, changes_, expected_, accelerations_;
};

}  // namespace hookpoint::reference
