// PID on the error for P and I and on the measured value for D (a step of the goal makes no kick),
// with a filtered derivative, a limited output and an integral that stops while the limit holds.
// Source: Åström & Hägglund, PID Controllers, 2nd ed. (1995), sections 3.4 (derivative of the
// measured value, filter), 3.5 (windup, conditional integration), 3.6 (discretisation).
#include <algorithm>
#include <stdexcept>

#include "control/component.h"
#include "control/components/sampled_rate.h"
#include "control/registry.h"

namespace hookpoint::control {
namespace {

class PID final : public Component {
 public:
  Parameter goal{*this, "goal", "?", 0., "value that current is to reach"};
  Parameter pconstant{*this, "pconstant", "?", 0., "output per error"};
  Parameter iconstant{*this, "iconstant", "?", 0., "output per integral of the error"};
  Parameter dconstant{*this, "dconstant", "?", 0., "output per rate"};
  Parameter filter_time =
      Parameter{*this, "filter_time", "s", 0., "time constant of the derivative's low-pass filter"}
          .range(0., 1e6);
  Parameter output_min{*this, "output_min", "?", -1e9, "least output"};
  Parameter output_max{*this, "output_max", "?", 1e9, "greatest output"};
  Input current{*this, "current", "?", "the value controlled: a joint's angle"};
  Input rate_in{*this, "rate_in", "?",
                "d(current)/dt: a joint's rate; if not wired, from successive samples"};
  Output output{*this, "output", "?", "to a joint's torque"};
  State integral{*this, "integral", "?", "what the integral adds to the output"};
  State derivative{*this, "derivative", "?", "d(current)/dt, filtered"};
  State previous{*this, "previous", "?", "current at the last update"};

  void start(double) override {
    if (output_min > output_max) throw std::runtime_error("output_min is above output_max");
  }

  void update(const Tick& tick) override {
    filter_derivative(tick);
    const double error = goal - current;
    const double wanted = pconstant * error + integral - dconstant * derivative;
    output = std::max<double>(output_min, std::min<double>(output_max, wanted));
    const double increment = iconstant * error * tick.period;
    const bool winds_up =
        (wanted > output_max && increment > 0.) || (wanted < output_min && increment < 0.);
    if (!winds_up) integral = integral + increment;
    previous = current;
  }

  std::vector<LinearFeedback> linearise() const override {
    return {{.input = current.index(),
             .output = output.index(),
             .rate = rate_in.index(),
             .goal = goal.index(),
             .gains = {.proportional = pconstant,
                       .derivative = dconstant,
                       .integral = iconstant,
                       .filter_time = filter_time,
                       .differenced = !rate_in.driven()}}};
  }

 private:
  /// Tf dD/dt = d(current)/dt - D by backward differences; D starts at the first rate known.
  void filter_derivative(const Tick& tick) {
    const double rate = sampled_rate(rate_in, current, previous, tick);
    if (tick.count == 0) {
      derivative = rate;
    } else {
      derivative = derivative + (rate - derivative) * tick.period / (filter_time + tick.period);
    }
  }
};

}  // namespace
HOOKPOINT_REGISTER_COMPONENT(PID, "Controller.PID",
                             "output = pconstant (goal - current) + iconstant integral of "
                             "(goal - current) - dconstant d(current)/dt, within limits",
                             Attachment::none, "current")
}  // namespace hookpoint::control
