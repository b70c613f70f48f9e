// What its input was, so many of its own updates ago. The samples are kept in a ring, whose oldest
// is the output.
#include <cmath>
#include <stdexcept>

#include "control/component.h"
#include "control/registry.h"

namespace hookpoint::control {
namespace {

class Delay final : public Component {
 public:
  static constexpr std::size_t most = 256;

  Input input{*this, "input", "?", "what is delayed"};
  Parameter time = Parameter{*this, "time", "s", 0.,
                             "how much later the input arrives: whole updates, at least "
                             "as long; at most 256 (a wire's `delay` has no such limit)"}
                       .range(0., 1e6);
  Parameter initial{*this, "initial", "?", 0., "output before the first input arrives"};
  Output output{*this, "output", "?", "the input as it was"};
  State samples{*this, "samples", "?", "the last inputs, a ring", most};

  void start(double period) override {
    // A millionth of an update less counts as reached: decimal times are not exact in binary.
    const double updates = std::ceil(time / period - 1e-6);
    if (updates > static_cast<double>(most))
      throw std::runtime_error(
          "time is longer than 256 updates: lower `rate`, or give a wire the `delay`");
    length_ = static_cast<std::int64_t>(updates);
  }

  void update(const Tick& tick) override {
    if (length_ == 0) {
      output = input;
      return;
    }
    const auto place = static_cast<std::size_t>(tick.count % length_);
    output = tick.count < length_ ? double{initial} : samples.get(place);
    samples.set(place, input);
  }

 private:
  std::int64_t length_ = 0;
};

}  // namespace
HOOKPOINT_REGISTER_COMPONENT(Delay, "Delay", "output = input, `time` earlier", Attachment::none,
                             "input")
}  // namespace hookpoint::control
