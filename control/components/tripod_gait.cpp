// Two tripods in turn on one clock: while one swings the other carries the body.
#include <algorithm>

#include "control/components/hexapod_gait.h"
#include "control/registry.h"

namespace hookpoint::control {
namespace {

class TripodGait final : public HexapodGait {
 public:
  Parameter period =
      Parameter{*this, "period", "s", 0.6, "of a whole step, stance and swing"}.range(1e-3, 1e3);
  Parameter duty_factor =
      Parameter{*this, "duty_factor", "", 0.55, "part of the period in stance"}.range(0.5, 0.99);

  State clock{*this, "clock", "",
              "0 at touch-down, duty_factor at lift-off, 1 at the next touch-down", leg_count};
  State in_air{*this, "in_air", "", "1 while the clock is in the swing", leg_count};

 private:
  void begin() override {
    // The first tripod is about to swing, the other half a period from it.
    for (std::size_t leg = 0; leg < leg_count; ++leg) {
      clock.set(leg, in_first_tripod(leg) ? duty_factor : duty_factor - 0.5);
      in_air.set(leg, 0.);
    }
  }

  void step(double dt) override {
    const PlanarTwist twist = follow_command(dt);
    // A wire may bring any period: not one so short that the clock would turn without end.
    const double turned = dt / std::max<double>(period, 1e-3);
    for (std::size_t leg = 0; leg < leg_count; ++leg) advance(leg, turned, twist);
  }

  double phase_of(std::size_t leg) const override {
    const double now = clock.get(leg);
    return in_air.get(leg) > 0.5 ? 0.5 + 0.5 * swing_share(now)
                                 : 0.5 * std::min(1., now / duty_factor);
  }

  double swing_share(double now) const {
    return std::clamp((now - duty_factor) / (1. - duty_factor), 0., 1.);
  }

  /// The leg's clock runs on by `left`, from 0 at touch-down through `duty_factor` at lift-off
  /// to 1.
  void advance(std::size_t leg, double left, const PlanarTwist& twist) {
    FootPath& foot = feet_[leg];
    while (left > 0.) {
      const double now = clock.get(leg);
      const double share =
          std::min(left, std::max(0., (in_air.get(leg) > 0.5 ? 1. : duty_factor) - now));
      clock.set(leg, now + share);
      left -= share;
      if (!foot.swinging()) {
        foot.stand(twist, share * period, search(leg));
      } else {
        swing(leg, swing_share(now + share), twist);
      }
      if (left > 0.) change_phase(leg, twist);
    }
  }

  void swing(std::size_t leg, double done, const PlanarTwist& twist) {
    // It lands half a stance before the neutral position.
    const Vector3d target = carried(neutral(leg), twist, -0.5 * duty_factor * period);
    feet_[leg].swing(done, target, twist, (1. - duty_factor) * period, step_height);
    if (meets_ground(leg)) feet_[leg].touch_down();
  }

  void change_phase(std::size_t leg, const PlanarTwist& twist) {
    const bool lands = in_air.get(leg) > 0.5;
    if (lands) {
      feet_[leg].touch_down();
    } else {
      feet_[leg].lift_off(twist);
    }
    clock.set(leg, lands ? 0. : duty_factor);
    in_air.set(leg, lands ? 0. : 1.);
  }
};

HOOKPOINT_REGISTER_COMPONENT(TripodGait, "Controller.TripodGait",
                             "joint goals of a hexapod that walks in alternating tripods",
                             Attachment::none, "forward", "goal")

}  // namespace
}  // namespace hookpoint::control
