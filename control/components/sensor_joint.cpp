// An ideal encoder and tachometer on a joint. Sampling, delay and noise are those of its stub and
// wires.
#include "control/registry.h"

namespace hookpoint::control {
namespace {

class JointSensor final : public Component {
 public:
  Input angle_in = Input{*this, "angle_in", "rad", "angle of the joint"}.attached("angle");
  Input rate_in = Input{*this, "rate_in", "rad/s", "rate of the joint"}.attached("rate");
  Output angle{*this, "angle", "rad", "measured angle"};
  Output angle_rate{*this, "angle_rate", "rad/s", "measured rate"};

  void update(const Tick&) override {
    angle = angle_in;
    angle_rate = rate_in;
  }
};

HOOKPOINT_REGISTER_COMPONENT(JointSensor, "Sensor.Joint", "angle and rate of a joint",
                             Attachment::joint, "", "angle")

}  // namespace
}  // namespace hookpoint::control
