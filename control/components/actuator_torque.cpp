// A drive that does what it is told, up to its limit.
#include <algorithm>

#include "control/registry.h"

namespace hookpoint::control {
namespace {

class TorqueActuator final : public Component {
 public:
  Parameter limit =
      Parameter{*this, "limit", "N.m", 1e9, "greatest torque in either direction"}.range(0., 1e9);
  Input command{*this, "command", "N.m", "wanted torque"};
  Output torque = Output{*this, "torque", "N.m", "torque on the joint"}.attached("torque");

  void update(const Tick&) override { torque = std::clamp<double>(command, -limit, limit); }
};

HOOKPOINT_REGISTER_COMPONENT(TorqueActuator, "Actuator.Torque", "ideal torque within a limit",
                             Attachment::joint, "command", "torque")

}  // namespace
}  // namespace hookpoint::control
