// Controllers that are wired from joints to joints, as the feedback that they are: what they add to
// a robot's joint springs and dampers, and how late.
#pragma once

#include <optional>
#include <span>
#include <string>
#include <vector>

#include "simulation/experiment.h"

namespace hookpoint::simulation {

/// torque of joint `driven` = -proportional q - derivative q' - integral of q dt about a rest, with
/// q the position of joint `sensed`. Joints are numbered along the robot's chains.
struct JointLoop {
  std::string controller;  ///< its trail
  std::size_t robot = 0, sensed = 0, driven = 0;
  double proportional = 0.;  ///< [N m/rad or N/m]
  double derivative = 0.;    ///< [N m s/rad or N s/m]
  double integral = 0.;      ///< [N m/(rad s) or N/(m s)]
  bool differenced = false;  ///< q' from successive samples of q, not from the joint's rate
  double filter_time = 0.;   ///< time constant of the low-pass filter of q' [s]
  double period = 0.;        ///< from one update to the next [s]; 0: every step
  double delay = 0.;         ///< of q on its way there and back [s]
  double rate_delay = 0.;    ///< of q' [s]
};

/// A joint whose torque is wired.
struct DrivenJoint {
  std::size_t robot = 0, joint = 0;
  /// Of a PD alone, with a goal that no wire moves: torque = proportional (goal - q) at rest.
  std::optional<double> goal;  ///< [rad or m]
  double proportional = 0.;    ///< [N m/rad or N/m]
};

struct WiredControl {
  std::vector<JointLoop> loops;     ///< robot by robot
  std::vector<DrivenJoint> driven;  ///< robot by robot, joint by joint
  /// What feeds back and is no such loop, each with the reason in words: components that follow
  /// what robots do and whose outputs reach a force or a torque, and ports of robots that are wired
  /// there straight.
  std::vector<std::string> left_out;
};

/// Those of one robot. O(log loops).
std::span<const JointLoop> loops_of(const WiredControl& control, std::size_t robot);
std::span<const DrivenJoint> driven_of(const WiredControl& control, std::size_t robot);

/// Of `Controller.PD`, `.PID` and `.JointPD` between the `angle`, `rate` and `torque` of one
/// robot's joints; limits of torques are not reached about a rest. O(wires log wires).
WiredControl wired_control(const Experiment& experiment);

}  // namespace hookpoint::simulation
