// Two classes, one by a name that the program has: neither may be registered.
#include "control/component.h"
#include "control/registry.h"

namespace {

using namespace hookpoint::control;

class Mine final : public Component {
 public:
  Output output{*this, "output", "", "nothing"};
  void update(const Tick&) override {}
};

HOOKPOINT_REGISTER_COMPONENT(Mine, "Controller.PD", "not the program's")
const Registration second(describe_class<Mine>("Test.Second", "beside it"));

}  // namespace
