// A controller with an endless loop: what a user's own code may do to a step.
#include <unistd.h>

#include "control/component.h"
#include "control/registry.h"

namespace {

using namespace hookpoint::control;

class Stalls final : public Component {
 public:
  Parameter at{*this, "at", "s", 0., "from this time on an update does not end"};
  Output output{*this, "output", "", "nothing"};
  void update(const Tick& tick) override {
    if (tick.time < at) return;
    constexpr char told[] = "stalled\n";
    if (write(STDERR_FILENO, told, sizeof told - 1) < 0) return;
    while (true) pause();
  }
};

HOOKPOINT_REGISTER_COMPONENT(Stalls, "Test.Stalls", "hangs")

}  // namespace
