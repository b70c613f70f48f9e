// A muscle after Hill, with an inextensible tendon and a constant moment arm. With l and v the
// length and the speed of lengthening of its fibres in optimal lengths, a the activation and u the
// excitation:
//
//   F = maximum_force (a f_l(l) f_v(v/maximum_speed) + f_p(l))          torque = moment_arm F
//   l = 1 - moment_arm (angle - optimal_angle)/optimal_length
//   v = -moment_arm rate/optimal_length
//   da/dt = (u - a)/(activation_time if u > a, else deactivation_time)
//
// It pulls only. A positive moment arm turns the joint towards greater angles (agonist), a negative
// one back (antagonist). Sources: structure, Zajac, Crit. Rev. Biomed. Eng. 17 (1989) 359-411;
// curves and constants, Thelen, J. Biomech. Eng. 125 (2003) 70-77, simplified: rigid tendon, no
// pennation, force-velocity curve and activation times independent of activation.
#include <algorithm>
#include <cmath>

#include "control/first_order.h"
#include "control/registry.h"

namespace hookpoint::control {
namespace {

/// Overlap of the filaments: exp(-(l - 1)^2/0.45).
double force_length(double length) { return std::exp(-(length - 1.) * (length - 1.) / 0.45); }

/// Hill's hyperbola while it shortens, `speed` = v/v_max from 0 to -1; while it lengthens a
/// hyperbola to 1.4 with the same slope at 0.
double force_velocity(double speed) {
  constexpr double curvature = 0.25, eccentric = 1.4;
  constexpr double knee = (eccentric - 1.) * curvature / (1. + curvature);
  if (speed > 0.) return eccentric - (eccentric - 1.) * knee / (knee + speed);
  return std::max(0., (1. + speed) / (1. - speed / curvature));
}

/// Parallel element: slack below the optimal length, 1 at a strain of 0.6.
double force_parallel(double length) {
  constexpr double shape = 5., strain = 0.6;
  return length > 1. ? std::expm1(shape * (length - 1.) / strain) / std::expm1(shape) : 0.;
}

class Muscle final : public Component {
 public:
  Parameter maximum_force = Parameter{*this, "maximum_force", "N", 100.,
                                      "isometric, at optimal length and full activation"}
                                .range(0., 1e9);
  Parameter optimal_length =
      Parameter{*this, "optimal_length", "m", 0.1, "of the fibres, where they are strongest"}.range(
          1e-9, 1e9);
  Parameter maximum_speed =
      Parameter{*this, "maximum_speed", "Hz", 10., "of shortening, in optimal lengths a second"}
          .range(1e-9, 1e9);
  Parameter moment_arm{*this, "moment_arm", "m", 0.02,
                       "about the joint; positive pulls towards greater angles"};
  Parameter optimal_angle{*this, "optimal_angle", "rad", 0.,
                          "angle of the joint at which the fibres have their optimal length"};
  Parameter activation_time =
      Parameter{*this, "activation_time", "s", 0.015, "time constant while the activation rises"}
          .range(0., 1e9);
  Parameter deactivation_time =
      Parameter{*this, "deactivation_time", "s", 0.05, "time constant while the activation falls"}
          .range(0., 1e9);
  Input excitation{*this, "excitation", "", "drive of the nerve, 0 ... 1"};
  Input angle_in = Input{*this, "angle_in", "rad", "angle of the joint"}.attached("angle");
  Input rate_in = Input{*this, "rate_in", "rad/s", "rate of the joint"}.attached("rate");
  Output torque = Output{*this, "torque", "N.m", "torque on the joint"}.attached("torque");
  Output force{*this, "force", "N", "pull of the muscle"};
  Output length{*this, "length", "", "of the fibres, in optimal lengths"};
  State activation{*this, "activation", "", "0 ... 1"};
  State held{*this, "held", "", "excitation, within 0 ... 1, since the last update"};

  void update(const Tick& tick) override {
    if (tick.count > 0) {
      const double time = held > activation ? activation_time : deactivation_time;
      activation = relaxed(activation, held, tick.period, time);
    }
    held = std::clamp<double>(excitation, 0., 1.);
    length = 1. - moment_arm * (angle_in - optimal_angle) / optimal_length;
    const double speed = -moment_arm * rate_in / (optimal_length * maximum_speed);
    force = maximum_force *
            (activation * force_length(length) * force_velocity(speed) + force_parallel(length));
    torque = moment_arm * force;
  }
};

HOOKPOINT_REGISTER_COMPONENT(Muscle, "Actuator.Muscle",
                             "Hill-type muscle with a constant moment arm", Attachment::joint,
                             "excitation", "torque")

}  // namespace
}  // namespace hookpoint::control
