// Where a body is, as an overhead camera sees it.
#include "control/registry.h"

namespace hookpoint::control {
namespace {

class PositionSensor final : public Component {
 public:
  Input location =
      Input{*this, "location", "m", "of the body's frame, world axes", 0., 3}.attached("location");
  Output position{*this, "position", "m", "measured position, world axes x, y, z", 3};

  void update(const Tick&) override {
    for (std::size_t axis = 0; axis < 3; ++axis) position.set(axis, location[axis]);
  }
};

HOOKPOINT_REGISTER_COMPONENT(PositionSensor, "Sensor.Position", "position of a body",
                             Attachment::body, "", "position")

}  // namespace
}  // namespace hookpoint::control
