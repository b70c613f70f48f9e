// A brushed motor and its gear. The motor's torque falls linearly with its speed, because its own
// voltage opposes the supply. With i the current as a part of the stall current:
//
//   i = command - w/no_load_speed       w = gear_ratio rate       D = gear_ratio stall_torque i
//
// (Fitzgerald, Kingsley & Umans, Electric Machinery, 6th ed., chapter 7). The teeth rub in
// proportion to the load L that the gear carries, the torque at the joint: with the efficiency e of
// a motor that drives it,
//
//   L = D - F       |F| <= m |L|, against the motion       m = 1/e - 1
//
// so that L = e D while the motor drives the joint and D = (2 - 1/e) L while the joint drives the
// motor: a gear has the efficiency 2 - 1/e backwards, and below e = 1/2 no load turns it, it locks
// (power screws: Budynas & Nisbett, Shigley's Mechanical Engineering Design, section 8-2; gears:
// Niemann & Winter, Maschinenelemente III, section 24). Of a joint that stands still F is any within
// its bounds, as a spring and a damper find it that are hooked where the gear has last slipped.
//
// The rotor's inertia J is not felt here: taken from a difference of rates it would feed back the
// acceleration of the step before, which diverges as soon as gear_ratio^2 J exceeds the inertia of
// the joint. It belongs to the link (docs/sensors_actuators.md). What a gear that locks carries
// while its motor turns it the way that the load pulls depends on it: L = D - F - rotor_inertia a of
// the update before.
#include <algorithm>
#include <cmath>
#include <limits>

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
  Parameter efficiency = Parameter{*this, "efficiency", "", 1.,
                                   "of the gear, e: power out by power in while the motor drives; "
                                   "2 - 1/e while the joint does, and below 1/2 it locks"}
                             .range(1e-3, 1.);
  Parameter deflection = Parameter{*this, "deflection", "?", 1e-3,
                                   "of the joint under the stall torque while the gear's friction "
                                   "holds it, efficiency below 1; rad, m of one that slides"}
                             .range(1e-9, 1e9);
  Parameter relaxation = Parameter{*this, "relaxation", "s", 2e-3,
                                   "damper by spring of the gear while its friction holds it"}
                             .range(0., 1e9);
  Parameter current_limit =
      Parameter{*this, "current_limit", "", 2., "greatest current, as a part of the stall current"}
          .range(0., 1e9);
  Input command{*this, "command", "", "voltage as a part of the full voltage, -1 ... 1"};
  Input rate_in = Input{*this, "rate_in", "rad/s", "rate of the joint"}.attached("rate");
  Input angle_in = Input{*this, "angle_in", "rad", "angle of the joint"}.attached("angle");
  Input rotor_inertia =
      Input{*this, "rotor_inertia", "kg.m^2", "of motor and gear, at the joint"}.attached(
          "rotor_inertia");
  Output torque = Output{*this, "torque", "N.m", "torque on the joint"}.attached("torque");
  Output current{*this, "current", "", "as a part of the stall current"};
  State hook{*this, "hook", "?", "angle of the joint at which the gear's spring is slack"};
  State last_rate{*this, "last_rate", "?", "rate of the joint at the last update"};

  void update(const Tick& tick) override {
    const double voltage = std::clamp<double>(command, -1., 1.);
    current = std::clamp<double>(voltage - gear_ratio * rate_in / no_load_speed, -current_limit,
                                 current_limit);
    const double drive = gear_ratio * stall_torque * current;
    const double load =
        tick.count == 0 ? 0. : torque - rotor_inertia * (rate_in - last_rate) / tick.period;
    last_rate = rate_in;
    torque = drive - friction(drive, load, tick.count == 0);
  }

  // About a joint that the gear's friction holds.
  std::vector<LinearFeedback> linearise() const override {
    const double stiffness = spring();
    return {{.input = angle_in.index(),
             .output = torque.index(),
             .rate = rate_in.index(),
             .gains = {.proportional = stiffness,
                       .derivative = stiffness * relaxation +
                                     gear_ratio * gear_ratio * stall_torque / no_load_speed}}};
  }

 private:
  double rubbing() const { return 1. / efficiency - 1.; }
  /// Of the gear that friction holds [N m/rad]; 0 of one without friction.
  double spring() const { return efficiency < 1. ? gear_ratio * stall_torque / deflection : 0.; }

  /// The most by which friction opposes a motion the way that `drive` and `load` are positive.
  double most(double drive, double load) const {
    const double m = rubbing();
    const bool locks = m >= 1.;
    if (drive < 0.) return locks ? std::numeric_limits<double>::infinity() : -drive * m / (1. - m);
    if (locks && load < 0.) return drive > 0. ? -load * m : most(-1., load);
    if (locks && drive == 0.) return most(-1., load);
    return (1. - efficiency) * drive;
  }

  /// F [N m]. At first as if the motor had begun to turn the joint.
  double friction(double drive, double load, bool first) {
    const double stiffness = spring();
    if (stiffness == 0.) return 0.;
    const double forwards = most(drive, load), backwards = most(-drive, -load);
    if (first) hook = angle_in - (drive > 0. ? forwards : drive < 0. ? -backwards : 0.) / stiffness;
    const double stretch =
        std::clamp(angle_in - hook, -backwards / stiffness, forwards / stiffness);
    hook = angle_in - stretch;
    return std::clamp(stiffness * (stretch + relaxation * rate_in), -backwards, forwards);
  }
};

HOOKPOINT_REGISTER_COMPONENT(DirectCurrentMotor, "Actuator.DCMotor",
                             "brushed motor with torque-speed line, current limit and gear",
                             Attachment::joint, "command", "torque")

}  // namespace
}  // namespace hookpoint::control
