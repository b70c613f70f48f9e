// A brushed motor and its gear. The motor's torque falls linearly with its speed, because its own
// voltage opposes the supply. With i the current as a part of the stall current:
//
//   i = command - w/no_load_speed       w = gear_ratio rate       motor torque = stall_torque i
//
// The gear loses 1 - efficiency of the power, whichever way it flows. Source: Fitzgerald, Kingsley
// & Umans, Electric Machinery, 6th ed., chapter 7. The rotor's inertia J is not felt here: taken
// from a difference of rates it would feed back the acceleration of the step before, which diverges
// as soon as gear_ratio^2 J exceeds the inertia of the joint. It belongs to the link
// (docs/sensors_actuators.md).
#include <algorithm>

#include "control/registry.h"

namespace hookpoint::control {
namespace {

class DirectCurrentMotor final : public Component {
 public:
  Parameter stall_torque =
      Parameter{*this, "stall_torque", "N.m", 0.1, "of the motor at standstill and full voltage"}
          .range(0., 1e9);
  Parameter no_load_speed =
      Parameter{*this, "no_load_speed", "rad/s", 600., "of the motor without load at full voltage"}
          .range(1e-9, 1e9);
  Parameter gear_ratio =
      Parameter{*this, "gear_ratio", "", 100., "turns of the motor for one of the joint"}.range(
          1e-9, 1e9);
  Parameter efficiency =
      Parameter{*this, "efficiency", "", 1., "of the gear: power out by power in"}.range(1e-3, 1.);
  Parameter current_limit =
      Parameter{*this, "current_limit", "", 2., "greatest current, as a part of the stall current"}
          .range(0., 1e9);
  Input command{*this, "command", "", "voltage as a part of the full voltage, -1 ... 1"};
  Input rate_in = Input{*this, "rate_in", "rad/s", "rate of the joint"}.attached("rate");
  Output torque = Output{*this, "torque", "N.m", "torque on the joint"}.attached("torque");
  Output current{*this, "current", "", "as a part of the stall current"};

  void update(const Tick&) override {
    const double voltage = std::clamp<double>(command, -1., 1.);
    current = std::clamp<double>(voltage - gear_ratio * rate_in / no_load_speed, -current_limit,
                                 current_limit);
    const double lossless = gear_ratio * stall_torque * current;
    const bool drives = lossless * rate_in >= 0.;
    torque = drives ? efficiency * lossless : lossless / efficiency;
  }
};

HOOKPOINT_REGISTER_COMPONENT(DirectCurrentMotor, "Actuator.DCMotor",
                             "brushed motor with torque-speed line, current limit and gear",
                             Attachment::joint, "command", "torque")

}  // namespace
}  // namespace hookpoint::control
