#include "control/component.h"
#include "control/components/signal_time.h"
#include "control/registry.h"

namespace hookpoint::control {
namespace {

class Ramp final : public Component {
 public:
  Parameter initial{*this, "initial", "?", 0., "output before the ramp"};
  Parameter final_value{*this, "final", "?", 1., "output after the ramp"};
  Parameter start_time{*this, "start", "s", 0., "when it begins"};
  Parameter duration =
      Parameter{*this, "duration", "s", 1., "how long it lasts; 0: a step"}.range(0., 1e9);
  Output output{*this, "output", "?", "the signal"};

  void update(const Tick& tick) override {
    if (!reached(tick, start_time)) {
      output = double{initial};
    } else if (reached(tick, start_time + duration)) {
      output = double{final_value};
    } else {
      output = initial + (final_value - initial) * (tick.time - start_time) / duration;
    }
  }
};

}  // namespace
HOOKPOINT_REGISTER_COMPONENT(Ramp, "Signal.Ramp", "a straight line from one value to another")
}  // namespace hookpoint::control
