// Controllers that are wired from joints to joints, as the feedback that they are: what they add to
// a robot's joint springs and dampers, and how late.
#pragma once

#include <optional>
#include <span>
#include <string>
#include <vector>

#include "control/linear_feedback.h"
#include "simulation/experiment/experiment.h"

namespace hookpoint::simulation {

/// The torque of joint `driven` follows the position of joint `sensed` about a rest. Joints are
/// numbered along the robot's chains; gains in N m/rad or N/m, and s.
struct JointLoop {
  std::string controller;  ///< its trail
  std::size_t robot = 0, sensed = 0, driven = 0;
  control::FeedbackGains gains = {};
  std::optional<double> goal =
      {};                  ///< that the position is held to, where no wire moves it [rad or m]
  double period = 0.;      ///< from one update to the next [s]; 0: every step
  double delay = 0.;       ///< of the position on its way there and of the torque back [s]
  double rate_delay = 0.;  ///< of the rate, if the controller reads it [s]
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

/// Of components that linearise themselves (control::Component::linearise) between the `angle`,
/// `rate` and `torque` of one robot's joints. O(wires log wires).
WiredControl wired_control(const Experiment& experiment);

}  // namespace hookpoint::simulation
