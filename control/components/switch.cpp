// One of two inputs, by a third that has to pass a threshold with hysteresis: what trembles about
// the threshold does not switch back and forth.
#include "control/component.h"
#include "control/registry.h"

namespace hookpoint::control {
namespace {

class Switch final : public Component {
 public:
  Input control{*this, "control", "?", "what decides"};
  Input in{*this, "in", "?", "in[1] is put through while it is on, in[0] while it is off", 0., 2};
  Parameter threshold{*this, "threshold", "?", 0.5, "it is on where control is at or above"};
  Parameter hysteresis =
      Parameter{*this, "hysteresis", "?", 0., "it goes off that far below threshold"}.range(0.,
                                                                                            1e300);
  Output output{*this, "output", "?", "the input that is put through"};
  Output on{*this, "on", "", "1 while it is on, else 0"};

  void update(const Tick&) override {
    if (control >= threshold) {
      on = 1.;
    } else if (control < threshold - hysteresis) {
      on = 0.;
    }
    output = on > 0.5 ? in[1] : in[0];
  }
};

}  // namespace
HOOKPOINT_REGISTER_COMPONENT(Switch, "Switch",
                             "output = in[1] while control is above threshold, else in[0]",
                             Attachment::none, "control")
}  // namespace hookpoint::control
