#include "control/component.h"
#include "control/registry.h"

namespace hookpoint::control {
namespace {

class Gain final : public Component {
 public:
  Input input{*this, "input", "?", "what is multiplied"};
  Parameter gain{*this, "gain", "?", 1., "output per input"};
  Output output{*this, "output", "?", "gain times input"};

  void update(const Tick&) override { output = gain * input; }
};

}  // namespace
HOOKPOINT_REGISTER_COMPONENT(Gain, "Gain", "output = gain input", Attachment::none, "input")
}  // namespace hookpoint::control
