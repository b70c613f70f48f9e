// An <actuator> that acts on one joint: its torque as a function of ctrl, and what of that a servo of
// ours is.
#pragma once

#include <array>

#include "simulation/scene/mjcf/document.h"

namespace hookpoint::simulation {

/// torque = gear (gain ctrl + bias_0 + bias_1 gear q + bias_2 gear dq/dt)
struct MjcfActuator {
  double gear = 1., gain = 1.;
  std::array<double, 3> bias{0., 0., 0.};
  bool is_linear = true;        ///< as above; its bias and gain are not of another kind
  double inherited_range = 0.;  ///< part of the joint's range that ctrl may have
  bool holds_angle() const { return gain != 0. && bias[1] == -gain; }
  bool holds_rate() const { return gain != 0. && bias[1] == 0. && bias[2] == -gain; }
  bool is_motor() const { return bias[0] == 0. && bias[1] == 0. && bias[2] == 0.; }
  /// A servo that ours is too: without a constant torque.
  bool is_servo() const { return gear != 0. && bias[0] == 0. && (holds_angle() || holds_rate()); }
  /// Where bias_2 is a damping ratio, above 0, the damping that it means in front of a joint of that
  /// inertia M: 2 ratio sqrt(gain M / gear^2).
  void settle_damping(double inertia);
};

/// As the element's classes and itself make it, one tag over the other.
MjcfActuator read_mjcf_actuator(const MjcfAttributes& given);

}  // namespace hookpoint::simulation
