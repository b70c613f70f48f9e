#include "control/component.h"
#include "control/registry.h"

namespace hookpoint::control {
namespace {

class Sample final : public Component {
 public:
  Input input{*this, "input", "?", "what is sampled"};
  Input trigger{*this, "trigger", "?",
                "a sample is taken as it rises through threshold; not wired: at each update"};
  Parameter threshold{*this, "threshold", "?", 0.5, "of the trigger"};
  Parameter initial{*this, "initial", "?", 0., "output before the first sample"};
  Output output{*this, "output", "?", "the last sample"};
  State risen{*this, "risen", "", "1 while the trigger is at or above threshold"};

  void update(const Tick& tick) override {
    if (tick.count == 0) output = initial;
    const bool above = trigger >= threshold;
    if (!trigger.driven() || (above && risen < 0.5)) output = input;
    risen = above ? 1. : 0.;
  }
};

}  // namespace
HOOKPOINT_REGISTER_COMPONENT(Sample, "Sample", "holds its input as it was when the trigger rose",
                             Attachment::none, "input")
}  // namespace hookpoint::control
