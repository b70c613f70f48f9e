#include "control/component.h"
#include "control/components/sampled_rate.h"
#include "control/registry.h"

namespace hookpoint::control {
namespace {

class PD final : public Component {
 public:
  Parameter goal{*this, "goal", "?", 0., "value that current is to reach"};
  Parameter pconstant{*this, "pconstant", "?", 0., "output per error"};
  Parameter dconstant{*this, "dconstant", "?", 0., "output per rate"};
  Input current{*this, "current", "?", "the value controlled: a joint's angle"};
  Input rate_in{*this, "rate_in", "?",
                "d(current)/dt: a joint's rate; if not wired, from successive samples"};
  Output output{*this, "output", "?", "to a joint's torque"};
  State previous{*this, "previous", "?", "current at the last update"};

  void update(const Tick& tick) override {
    output =
        pconstant * (goal - current) - dconstant * sampled_rate(rate_in, current, previous, tick);
    previous = current;
  }

  std::vector<LinearFeedback> linearise() const override {
    return {{.input = current.index(),
             .output = output.index(),
             .rate = rate_in.index(),
             .goal = goal.index(),
             .gains = {.proportional = pconstant,
                       .derivative = dconstant,
                       .differenced = !rate_in.driven()}}};
  }
};

}  // namespace
HOOKPOINT_REGISTER_COMPONENT(PD, "Controller.PD",
                             "output = pconstant (goal - current) - dconstant d(current)/dt",
                             Attachment::none, "current")
}  // namespace hookpoint::control
