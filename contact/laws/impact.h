// Rebound of a point mass from a normal force without a closed form of its rebound.
#pragma once

#include <cmath>

namespace hookpoint::contact {

/// Rebound speed over impact speed of `mass` [kg] thrown down at `speed` [m/s] against
/// `force(depth, depth_rate)` [N], which is 0 outside and never pulls, no gravity: m d'' = -N
/// integrated by RK4 from touch-down until contact is lost. `stored_energy(depth)` [J], the work
/// of a slow press, gives the step: 1/2000 of the greatest depth without damping over the speed.
/// Some 10^4 evaluations; an overdamped point that still touches after 10^6 rebounds with what speed
/// it has then.
template <class Force, class Energy>
double integrated_restitution(const Force& force, const Energy& stored_energy, double mass,
                              double speed) {
  double deepest = 1e-9;
  while (stored_energy(deepest) < 0.5 * mass * speed * speed) deepest *= 1.1;
  const double dt = deepest / speed / 2000.;
  const auto acceleration = [&](double depth, double rate) { return -force(depth, rate) / mass; };
  double d = 0., v = speed;
  for (int i = 0; i < 1000000 && (v > 0. || force(d, v) > 0.); ++i) {
    const double v1 = v, a1 = acceleration(d, v1);
    const double v2 = v + 0.5 * dt * a1, a2 = acceleration(d + 0.5 * dt * v1, v2);
    const double v3 = v + 0.5 * dt * a2, a3 = acceleration(d + 0.5 * dt * v2, v3);
    const double v4 = v + dt * a3, a4 = acceleration(d + dt * v3, v4);
    d += dt / 6. * (v1 + 2. * v2 + 2. * v3 + v4);
    v += dt / 6. * (a1 + 2. * a2 + 2. * a3 + a4);
  }
  return -v / speed;
}

}  // namespace hookpoint::contact
