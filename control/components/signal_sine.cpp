#include <cmath>
#include <numbers>

#include "control/component.h"
#include "control/registry.h"

namespace hookpoint::control {
namespace {

class Sine final : public Component {
 public:
  Parameter amplitude{*this, "amplitude", "?", 1., "greatest deviation from offset"};
  Parameter frequency{*this, "frequency", "Hz", 1., "periods a second"};
  Parameter phase{*this, "phase", "rad", 0., "of the sine at time 0"};
  Parameter offset{*this, "offset", "?", 0., "mean value"};
  Output output{*this, "output", "?", "the signal"};

  void update(const Tick& tick) override {
    output = offset + amplitude * std::sin(2. * std::numbers::pi * frequency * tick.time + phase);
  }
};

}  // namespace
HOOKPOINT_REGISTER_COMPONENT(Sine, "Signal.Sine",
                             "output = offset + amplitude sin(2 pi frequency time + phase)")
}  // namespace hookpoint::control
