// A component in a family of shapes: it would stand, and let shapes stand, where they must not.
#include "control/component.h"
#include "control/registry.h"

namespace {

using namespace hookpoint::control;

class Shape final : public Component {
 public:
  Output output{*this, "output", "", "nothing"};
  void update(const Tick&) override {}
};

HOOKPOINT_REGISTER_COMPONENT(Shape, "Shape.Cloud", "no shape")

}  // namespace
