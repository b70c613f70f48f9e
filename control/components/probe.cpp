#include "control/component.h"
#include "control/registry.h"

namespace hookpoint::control {
namespace {

class Probe final : public Component {
 public:
  Input input{*this, "input", "?", "what is watched"};
  Output value{*this, "value", "?", "the same, to record or plot"};

  void update(const Tick&) override { value = double{input}; }
};

}  // namespace
HOOKPOINT_REGISTER_COMPONENT(Probe, "Probe", "watches a value: value = input", Attachment::none,
                             "input", "value")
}  // namespace hookpoint::control
