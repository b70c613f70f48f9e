// Needs a function that nobody has.
#include "control/component.h"
#include "control/registry.h"
#include "tests/plugins/leaves_a_mark.h"

namespace hookpoint::control {
double gain_of_tomorrow(double today);
}

namespace {

using namespace hookpoint::control;

class Tomorrow final : public Component {
 public:
  Output output{*this, "output", "", "a gain"};
  void update(const Tick&) override { output = gain_of_tomorrow(1.); }
};

HOOKPOINT_REGISTER_COMPONENT(Tomorrow, "Test.Tomorrow", "ahead of its time")

}  // namespace
