// Two ports of one name.
#include "control/component.h"
#include "control/registry.h"

namespace {

using namespace hookpoint::control;

class Twice final : public Component {
 public:
  Input in{*this, "in", "", "first"};
  Input again{*this, "in", "", "second"};
  Output output{*this, "output", "", "nothing"};
  void update(const Tick&) override {}
};

HOOKPOINT_REGISTER_COMPONENT(Twice, "Test.Twice", "two ports of one name")

}  // namespace
