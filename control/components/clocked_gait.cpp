#include "control/components/clocked_gait.h"

#include <algorithm>

namespace hookpoint::control {

void ClockedGait::step(double dt) {
  const PlanarTwist twist = follow_command(dt);
  // A wire may bring any period: not one so short that the clock would turn without end.
  const double turned = dt / std::max<double>(period, 1e-3);
  for (std::size_t leg = 0; leg < legs(); ++leg) advance(leg, turned, twist);
}

double ClockedGait::phase_of(std::size_t leg) const {
  const double now = clock.get(leg);
  return in_air.get(leg) > 0.5 ? 0.5 + 0.5 * swing_share(now)
                               : 0.5 * std::min(1., now / duty_factor);
}

double ClockedGait::swing_share(double now) const {
  return std::clamp((now - duty_factor) / (1. - duty_factor), 0., 1.);
}

void ClockedGait::advance(std::size_t leg, double left, const PlanarTwist& twist) {
  FootPath& foot = feet_[leg];
  while (left > 0.) {
    const double now = clock.get(leg);
    // A leg that stands where its clock is in the swing stands on to the clock's end.
    const bool to_end = in_air.get(leg) > 0.5 || now > duty_factor;
    const double share = std::min(left, std::max(0., (to_end ? 1. : duty_factor) - now));
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

void ClockedGait::swing(std::size_t leg, double done, const PlanarTwist& twist) {
  // It lands half a stance before the neutral position.
  const Vector3d target =
      carried(neutral(leg), twist, -0.5 * duty_factor * period) + placement(leg);
  feet_[leg].swing(done, target, twist, (1. - duty_factor) * period, swing_height());
  if (meets_ground(leg)) feet_[leg].touch_down();
}

void ClockedGait::change_phase(std::size_t leg, const PlanarTwist& twist) {
  const bool lands = in_air.get(leg) > 0.5;
  const bool lifts = !lands && clock.get(leg) <= duty_factor;
  if (lands) feet_[leg].touch_down();
  if (lifts) feet_[leg].lift_off(twist);
  clock.set(leg, lifts ? duty_factor : 0.);
  in_air.set(leg, lifts ? 1. : 0.);
}

}  // namespace hookpoint::control
