#include "control/component.h"
#include "control/random.h"
#include "control/registry.h"

namespace hookpoint::control {
namespace {

/// Its n-th value depends on the World's seed, its own trail and seed, and n alone: nothing else of
/// the experiment disturbs it.
class Noise final : public Component {
 public:
  Parameter mean{*this, "mean", "?", 0., "mean value"};
  Parameter standard_deviation =
      Parameter{*this, "standard_deviation", "?", 1., "of each value"}.range(0., 1e9);
  Parameter seed =
      Parameter{*this, "seed", "", 0., "whole number; another gives other values"}.range(
          0., 9007199254740992.);  // 2^53: whole numbers up to here are exact
  Output output{*this, "output", "?", "the signal"};

  void start(double) override {
    values_ = RandomStream(stream_key(stream() + static_cast<std::uint64_t>(seed[0]), "seed"));
  }
  void update(const Tick& tick) override {
    output = mean + standard_deviation * values_.gaussian(static_cast<std::uint64_t>(tick.count));
  }

 private:
  RandomStream values_;
};

}  // namespace
HOOKPOINT_REGISTER_COMPONENT(Noise, "Signal.Noise",
                             "independent Gaussian values, a new one each update")
}  // namespace hookpoint::control
