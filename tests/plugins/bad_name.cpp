// A name that no file could write.
#include "control/component.h"
#include "control/registry.h"

namespace {

using namespace hookpoint::control;

class Named final : public Component {
 public:
  Output output{*this, "output", "", "nothing"};
  void update(const Tick&) override {}
};

HOOKPOINT_REGISTER_COMPONENT(Named, "Test.my class", "a blank in its name")

}  // namespace
