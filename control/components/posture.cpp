// Height and level of the body by the lengths of its legs.
#include <algorithm>
#include <cmath>

#include "control/components/hexapod_gait.h"
#include "control/registry.h"

namespace hookpoint::control {
namespace {

struct Gains {
  double p, i, limit;
};

/// u = p e + i (integral of e), within the limit; the integral waits while u is at its limit and e
/// would drive it further.
double proportional_integral(double error, double dt, const Gains& gains, State& integral) {
  const double grown = integral + gains.i * error * dt;
  if (std::abs(gains.p * error + grown) <= gains.limit ||
      std::abs(grown) < std::abs(integral.get(0)))
    integral = grown;
  return std::clamp(gains.p * error + integral, -gains.limit, gains.limit);
}

class Posture final : public Component {
 public:
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
  Parameter height_limit =
      Parameter{*this, "height_limit", "m", 0.03, "largest correction of height"}.range(0., 1e3);
  Parameter tilt_limit =
      Parameter{*this, "tilt_limit", "rad", 0.2, "largest correction of tilt"}.range(0., 1.5);
  Parameter foot_x{*this,    "foot_x", "m", 0., "neutral foot positions in the body's axes",
                   leg_count};
  Parameter foot_y{*this,    "foot_y", "m", 0., "neutral foot positions in the body's axes",
                   leg_count};

  Input height{*this, "height", "m", "measured height; without a wire it is not controlled"};
  Input roll{*this, "roll", "rad",
             "measured roll, positive with the left side up; without a wire it is not controlled"};
  Input pitch{*this, "pitch", "rad",
              "measured pitch, positive with the front down; without a wire it is not controlled"};

  Output height_offset{*this, "height_offset", "m", "what each leg is to be longer", leg_count};

  State height_integral{*this, "height_integral", "m", "integral part of the correction"};
  State roll_integral{*this, "roll_integral", "rad", "integral part of the correction"};
  State pitch_integral{*this, "pitch_integral", "rad", "integral part of the correction"};

  void update(const Tick& tick) override {
    const double dt = tick.count == 0 ? 0. : tick.period;
    const Gains length{height_p, height_i, height_limit}, tilt{tilt_p, tilt_i, tilt_limit};
    const double up = height.driven()
                          ? proportional_integral(goal_height - height, dt, length, height_integral)
                          : 0.;
    const double left =
        roll.driven() ? proportional_integral(goal_roll - roll, dt, tilt, roll_integral) : 0.;
    const double down =
        pitch.driven() ? proportional_integral(goal_pitch - pitch, dt, tilt, pitch_integral) : 0.;
    // A body that is to roll by `left` and pitch by `down` has its point (x, y) raised by y
    // tan(left) - x tan(down).
    for (std::size_t leg = 0; leg < leg_count; ++leg) {
      height_offset.set(leg, up + foot_y[leg] * std::tan(left) - foot_x[leg] * std::tan(down));
    }
  }
};

HOOKPOINT_REGISTER_COMPONENT(
    Posture, "Controller.Posture",
    "keeps a hexapod's body at a height and level by the lengths of its legs", Attachment::none,
    "height", "height_offset")

}  // namespace
}  // namespace hookpoint::control
