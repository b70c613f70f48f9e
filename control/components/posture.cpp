// Height and level of the body by the lengths of its legs.
#include <algorithm>
#include <cmath>

#include "control/registry.h"

namespace hookpoint::control {
namespace {

struct Gains {
  double p, i, limit;
};

/// u = p e + i (integral of e) - damping, within the limit; the integral waits while u is at its limit
/// and e would drive it further.
double correction(double error, double damping, double dt, const Gains& gains, State& integral) {
  const double grown = integral + gains.i * error * dt;
  const double rest = gains.p * error - damping;
  if (std::abs(rest + grown) <= gains.limit || std::abs(grown) < std::abs(integral.get(0)))
    integral = grown;
  return std::clamp(rest + integral, -gains.limit, gains.limit);
}

class Posture final : public Component {
 public:
  static constexpr std::size_t most = 16;

  Parameter legs =
      Parameter{*this, "legs", "", 6., "how many: 1 to 16"}.range(1., static_cast<double>(most));
  Parameter goal_height{*this, "goal_height", "m", 0.1, "wanted height"};
  Parameter goal_roll{*this, "goal_roll", "rad", 0., "wanted roll"};
  Parameter goal_pitch{*this, "goal_pitch", "rad", 0., "wanted pitch"};
  Parameter height_p =
      Parameter{*this, "height_p", "", 0.3, "leg length per height error"}.range(0., 1e6);
  Parameter height_i =
      Parameter{*this, "height_i", "Hz", 1., "leg length per height error and time"}.range(0., 1e6);
  Parameter tilt_p =
      Parameter{*this, "tilt_p", "", 0.3, "slope of the feet's plane per tilt error"}.range(0.,
                                                                                            1e6);
  Parameter tilt_i =
      Parameter{*this, "tilt_i", "Hz", 1., "slope of the feet's plane per tilt error and time"}
          .range(0., 1e6);
  Parameter tilt_d =
      Parameter{*this, "tilt_d", "s", 0., "slope of the feet's plane per rate of tilt"}.range(0.,
                                                                                              1e6);
  Parameter height_limit =
      Parameter{*this, "height_limit", "m", 0.03, "largest correction of height"}.range(0., 1e3);
  Parameter tilt_limit =
      Parameter{*this, "tilt_limit", "rad", 0.2, "largest correction of tilt"}.range(0., 1.5);
  Parameter foot_x =
      Parameter{*this, "foot_x", "m", 0., "neutral foot positions in the body's axes", most}
          .counted_by("legs");
  Parameter foot_y =
      Parameter{*this, "foot_y", "m", 0., "neutral foot positions in the body's axes", most}
          .counted_by("legs");

  Input height{*this, "height", "m", "measured height; without a wire it is not controlled"};
  Input roll{*this, "roll", "rad",
             "measured roll, positive with the left side up; without a wire it is not controlled"};
  Input pitch{*this, "pitch", "rad",
              "measured pitch, positive with the front down; without a wire it is not controlled"};

  Input roll_rate{*this, "roll_rate", "rad/s", "measured, as of a gyroscope about the body's x"};
  Input pitch_rate{*this, "pitch_rate", "rad/s", "measured, as of a gyroscope about the body's y"};

  Output height_offset{*this, "height_offset", "m", "what each leg is to be longer", most};

  State height_integral{*this, "height_integral", "m", "integral part of the correction"};
  State roll_integral{*this, "roll_integral", "rad", "integral part of the correction"};
  State pitch_integral{*this, "pitch_integral", "rad", "integral part of the correction"};

  void update(const Tick& tick) override {
    const double dt = tick.count == 0 ? 0. : tick.period;
    const Gains length{height_p, height_i, height_limit}, tilt{tilt_p, tilt_i, tilt_limit};
    const double up =
        height.driven() ? correction(goal_height - height, 0., dt, length, height_integral) : 0.;
    const double left =
        roll.driven() ? correction(goal_roll - roll, tilt_d * roll_rate, dt, tilt, roll_integral)
                      : 0.;
    const double down = pitch.driven() ? correction(goal_pitch - pitch, tilt_d * pitch_rate, dt,
                                                    tilt, pitch_integral)
                                       : 0.;
    // A body that is to roll by `left` and pitch by `down` has its point (x, y) raised by y
    // tan(left) - x tan(down).
    const auto count = static_cast<std::size_t>(legs);
    for (std::size_t leg = 0; leg < count; ++leg) {
      height_offset.set(leg, up + foot_y[leg] * std::tan(left) - foot_x[leg] * std::tan(down));
    }
  }
};

HOOKPOINT_REGISTER_COMPONENT(Posture, "Controller.Posture",
                             "keeps a body at a height and level by the lengths of its legs",
                             Attachment::none, "height", "height_offset")

}  // namespace
}  // namespace hookpoint::control
