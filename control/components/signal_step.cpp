#include "control/component.h"
#include "control/components/signal_time.h"
#include "control/registry.h"

namespace hookpoint::control {
namespace {

class Step final : public Component {
 public:
  Parameter initial{*this, "initial", "?", 0., "output before the step"};
  Parameter final_value{*this, "final", "?", 1., "output from the step on"};
  Parameter start_time{*this, "start", "s", 0., "when it steps"};
  Output output{*this, "output", "?", "the signal"};

  void update(const Tick& tick) override {
    output = double{reached(tick, start_time) ? final_value : initial};
  }
};

}  // namespace
HOOKPOINT_REGISTER_COMPONENT(Step, "Signal.Step", "one value until start, another from then on")
}  // namespace hookpoint::control
