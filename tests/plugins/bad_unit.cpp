// A unit that the language does not know.
#include "control/component.h"
#include "control/registry.h"

namespace {

using namespace hookpoint::control;

class Furlongs final : public Component {
 public:
  Output output{*this, "output", "furlong", "a distance"};
  void update(const Tick&) override {}
};

HOOKPOINT_REGISTER_COMPONENT(Furlongs, "Test.Furlongs", "a unit of its own")

}  // namespace
