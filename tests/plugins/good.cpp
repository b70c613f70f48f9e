// A component class as a third party writes it, in a family of its own.
#include "control/component.h"
#include "control/first_order.h"
#include "control/leg_kinematics.h"
#include "control/random.h"
#include "control/registry.h"
#include "tests/plugins/leaves_a_mark.h"

namespace {

using namespace hookpoint::control;

class Doubler final : public Component {
 public:
  Input in{*this, "in", "?", "any value"};
  Output output{*this, "output", "?", "twice the value"};
  void update(const Tick&) override { output = 2. * in; }
};

HOOKPOINT_REGISTER_COMPONENT(Doubler, "Test.Doubler", "twice its input", Attachment::none, "in")

}  // namespace
