// Filters of first and second order by the bilinear transform, prewarped so that the digital filter
// has the analog one's gain and phase at `frequency`:
//   s/w0 = (1/K) (1 - z^-1)/(1 + z^-1),  K = tan(pi frequency period)
// Source: Oppenheim & Schafer, Discrete-Time Signal Processing, 3rd ed. (2010), section 7.2.2.
#include <cmath>
#include <numbers>
#include <stdexcept>

#include "control/component.h"
#include "control/registry.h"

namespace hookpoint::control {
namespace {

class Filter final : public Component {
 public:
  Input input{*this, "input", "?", "what is filtered"};
  Text kind =
      Text{*this, "kind", "what passes: below frequency, above it, or around it", "low_pass"}
          .choices({"low_pass", "high_pass", "band_pass"});
  Parameter frequency =
      Parameter{*this, "frequency", "Hz", 10.,
                "the corner; of a band its middle; below half of the updates a second"}
          .range(1e-9, 1e9);
  Parameter order = Parameter{*this, "order", "", 2., "1 or 2; a band_pass has 2"}.range(1., 2.);
  Parameter quality = Parameter{*this, "quality", "", std::numbers::sqrt2 / 2.,
                                "of order 2: 0.7071 has the flattest pass band (Butterworth); of "
                                "a band_pass frequency over the width at half of the power"}
                          .range(1e-6, 1e6);
  Output output{*this, "output", "?", "what is left"};
  State inputs{*this, "inputs", "?", "the two before, the later first", 2};
  State outputs{*this, "outputs", "?", "the two before, the later first", 2};

  void start(double period) override {
    if (order != 1. && order != 2.) throw std::runtime_error("order is neither 1 nor 2");
    if (kind.value() == "band_pass" && order != 2.)
      throw std::runtime_error("a band_pass has order 2");
    if (frequency * period >= 0.5)
      throw std::runtime_error(
          "frequency is not below half of the updates a second: lower it, or raise `rate`");
    set_coefficients(std::tan(std::numbers::pi * frequency * period));
  }

  /// y_k = b0 x_k + b1 x_k-1 + b2 x_k-2 - a1 y_k-1 - a2 y_k-2, from the rest that the first input
  /// would have if it had always been there.
  void update(const Tick& tick) override {
    if (tick.count == 0) {
      const double rest = (b0_ + b1_ + b2_) / (1. + a1_ + a2_) * input;
      for (std::size_t i = 0; i < 2; ++i) {
        inputs.set(i, input);
        outputs.set(i, rest);
      }
    }
    output = b0_ * input + b1_ * inputs.get(0) + b2_ * inputs.get(1) - a1_ * outputs.get(0) -
             a2_ * outputs.get(1);
    inputs.set(1, inputs.get(0));
    inputs.set(0, input);
    outputs.set(1, outputs.get(0));
    outputs.set(0, output);
  }

 private:
  /// Of order 1: H = w0/(s + w0) or s/(s + w0). Of order 2 the denominator is s^2 + w0 s/Q + w0^2,
  /// the numerator w0^2, s^2 or w0 s/Q.
  void set_coefficients(double K) {
    const bool low = kind.value() == "low_pass", high = kind.value() == "high_pass";
    if (order == 1.) {
      b0_ = (low ? K : 1.) / (1. + K);
      b1_ = low ? b0_ : -b0_;
      a1_ = (K - 1.) / (K + 1.);
      return;
    }
    const double whole = 1. + K / quality + K * K;
    b0_ = (low ? K * K : high ? 1. : K / quality) / whole;
    b1_ = low ? 2. * b0_ : high ? -2. * b0_ : 0.;
    b2_ = low || high ? b0_ : -b0_;
    a1_ = 2. * (K * K - 1.) / whole;
    a2_ = (1. - K / quality + K * K) / whole;
  }

  double b0_ = 0., b1_ = 0., b2_ = 0., a1_ = 0., a2_ = 0.;
};

}  // namespace
HOOKPOINT_REGISTER_COMPONENT(Filter, "Filter",
                             "low pass, high pass or band pass of order 1 or 2, by the bilinear "
                             "transform",
                             Attachment::none, "input")
}  // namespace hookpoint::control
