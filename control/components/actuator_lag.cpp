// A drive that follows its command as a first-order lag: time_constant d(torque)/dt = command -
// torque.
#include <algorithm>

#include "control/first_order.h"
#include "control/registry.h"

namespace hookpoint::control {
namespace {

class LagActuator final : public Component {
 public:
  Parameter time_constant =
      Parameter{*this, "time_constant", "s", 0.02, "until 63 % of a step of the command is reached"}
          .range(0., 1e9);
  Parameter limit =
      Parameter{*this, "limit", "N.m", 1e9, "greatest torque in either direction"}.range(0., 1e9);
  Input command{*this, "command", "N.m", "wanted torque"};
  Output torque = Output{*this, "torque", "N.m", "torque on the joint"}.attached("torque");
  State held{*this, "held", "N.m", "command, within the limit, since the last update"};

  void update(const Tick& tick) override {
    // At an instant the torque is what the command before it has made of it.
    if (tick.count > 0) torque = relaxed(torque, held, tick.period, time_constant);
    held = std::clamp<double>(command, -limit, limit);
  }
};

HOOKPOINT_REGISTER_COMPONENT(LagActuator, "Actuator.Lag",
                             "torque that follows its command as a first-order lag",
                             Attachment::joint, "command", "torque")

}  // namespace
}  // namespace hookpoint::control
