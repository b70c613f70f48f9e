#include "control/component.h"
#include "control/registry.h"

namespace hookpoint::control {
namespace {

class Sum final : public Component {
 public:
  static constexpr std::size_t size = 8;

  Input in{*this, "in", "?", "what is added; 0 where nothing is wired", 0., size};
  Parameter weight{*this, "weight", "?", 1., "of each input: -1 subtracts", size};
  Output output{*this, "output", "?", "the weighted sum"};

  void update(const Tick&) override {
    double sum = 0.;
    for (std::size_t i = 0; i < size; ++i) sum += weight[i] * in[i];
    output = sum;
  }
};

}  // namespace
HOOKPOINT_REGISTER_COMPONENT(Sum, "Sum", "output = sum of weight[i] in[i]", Attachment::none, "in")
}  // namespace hookpoint::control
