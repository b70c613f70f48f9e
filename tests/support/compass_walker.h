// The compass-gait biped on rigid ground, which its feet neither slip nor bounce on: two rods with
// a point mass each, pivoted at a point mass, stand on one tip until the other meets the slope. The
// swing tip passes through the ground where the legs pass each other. Equations: Lagrange's of the
// two angles, and angular momentum about the landing foot and about the hip over the collision
// (Goswami, Thuilot & Espiau 1998; Garcia, Chatterjee, Ruina & Coleman 1998).
#pragma once

#include <array>
#include <cmath>
#include <stdexcept>
#include <utility>

namespace hookpoint::test_support {

struct CompassWalker {
  double hip_mass = 10., leg_mass = 5.;  ///< M, m [kg]
  double length = 1.;                    ///< l, of a leg [m]
  double com = 0.5;                      ///< c, of a leg's mass from the hip [m]
  double slope = 0.;                     ///< falls forwards [rad]
  double gravity = 9.81;
};

/// Angles of the stance and the swing leg from the vertical, forwards, and their rates.
struct CompassState {
  double stance = 0., swing = 0., stance_rate = 0., swing_rate = 0.;
};

inline CompassState moved(const CompassState& y, double h, const CompassState& rate) {
  return {y.stance + h * rate.stance, y.swing + h * rate.swing,
          y.stance_rate + h * rate.stance_rate, y.swing_rate + h * rate.swing_rate};
}

/// M(q) q'' = forces of gravity and of the rates.
inline CompassState compass_rates(const CompassWalker& w, const CompassState& y) {
  const double a = w.length - w.com;
  const double coupling = w.leg_mass * w.length * w.com;
  const double sine = std::sin(y.stance - y.swing);
  const double m11 = w.leg_mass * a * a + (w.hip_mass + w.leg_mass) * w.length * w.length;
  const double m12 = -coupling * std::cos(y.stance - y.swing);
  const double m22 = w.leg_mass * w.com * w.com;
  const double weight_moment =
      w.gravity * (w.leg_mass * a + (w.hip_mass + w.leg_mass) * w.length) * std::sin(y.stance);
  const double f1 = coupling * sine * y.swing_rate * y.swing_rate + weight_moment;
  const double f2 = -coupling * sine * y.stance_rate * y.stance_rate -
                    w.gravity * w.leg_mass * w.com * std::sin(y.swing);
  const double determinant = m11 * m22 - m12 * m12;
  return {y.stance_rate, y.swing_rate, (m22 * f1 - m12 * f2) / determinant,
          (m11 * f2 - m12 * f1) / determinant};
}

inline CompassState runge_kutta_step(const CompassWalker& w, const CompassState& y, double h) {
  const CompassState k1 = compass_rates(w, y);
  const CompassState k2 = compass_rates(w, moved(y, 0.5 * h, k1));
  const CompassState k3 = compass_rates(w, moved(y, 0.5 * h, k2));
  const CompassState k4 = compass_rates(w, moved(y, h, k3));
  return moved(moved(moved(moved(y, h / 6., k1), h / 3., k2), h / 3., k3), h / 6., k4);
}

/// Height of the swing tip over the slope [m].
inline double swing_clearance(const CompassWalker& w, const CompassState& y) {
  return w.length * (std::cos(y.stance - w.slope) - std::cos(y.swing - w.slope));
}
/// Whether the swing tip meets the ground between two states: it comes down ahead of the hip.
inline bool lands(const CompassWalker& w, const CompassState& before, const CompassState& after) {
  return after.stance > w.slope && after.swing < w.slope && swing_clearance(w, before) > 0. &&
         swing_clearance(w, after) <= 0.;
}

/// The legs after the swing tip has landed, the landed one as the new stance leg. Impulses act on
/// that tip alone.
inline CompassState after_collision(const CompassWalker& w, const CompassState& y) {
  struct Planar {
    double x, z;
  };
  const auto times = [](double factor, const Planar& p) {
    return Planar{factor * p.x, factor * p.z};
  };
  const auto minus = [](const Planar& p, const Planar& q) { return Planar{p.x - q.x, p.z - q.z}; };
  const auto moment = [](const Planar& r, const Planar& v) { return r.z * v.x - r.x * v.z; };
  const auto along = [](double angle) { return Planar{std::sin(angle), std::cos(angle)}; };
  const auto across = [](double angle) { return Planar{std::cos(angle), -std::sin(angle)}; };
  const double l = w.length, c = w.com, a = l - c;

  // From the landing tip: hip, mass of the old stance leg (also from the hip), of the landing leg.
  const Planar hip = times(l, along(y.swing));
  const Planar trailing_from_hip = times(-c, along(y.stance));
  const Planar trailing = minus(hip, times(c, along(y.stance)));
  const Planar landing = times(a, along(y.swing));
  const Planar hip_speed = times(l * y.stance_rate, across(y.stance));
  const Planar trailing_speed = times(a * y.stance_rate, across(y.stance));
  const Planar landing_speed = minus(hip_speed, times(c * y.swing_rate, across(y.swing)));
  const double about_tip =
      w.hip_mass * moment(hip, hip_speed) +
      w.leg_mass * (moment(trailing, trailing_speed) + moment(landing, landing_speed));
  const double about_hip = w.leg_mass * moment(trailing_from_hip, trailing_speed);

  // The same of unit rates afterwards, of the landed leg and of the one that now swings.
  const Planar hip_unit = times(l, across(y.swing)), swing_unit = times(-c, across(y.stance));
  const double tip_by_stance =
      w.hip_mass * moment(hip, hip_unit) + w.leg_mass * (moment(trailing, hip_unit) + a * a);
  const double tip_by_swing = w.leg_mass * moment(trailing, swing_unit);
  const double hip_by_stance = w.leg_mass * moment(trailing_from_hip, hip_unit);
  const double hip_by_swing = w.leg_mass * moment(trailing_from_hip, swing_unit);
  const double determinant = tip_by_stance * hip_by_swing - tip_by_swing * hip_by_stance;
  return {y.swing, y.stance, (about_tip * hip_by_swing - tip_by_swing * about_hip) / determinant,
          (tip_by_stance * about_hip - hip_by_stance * about_tip) / determinant};
}

/// The walker from one collision to after the next.
struct CompassStep {
  CompassState landed;  ///< just before the collision
  CompassState next;    ///< just after it
  double period = 0.;   ///< [s]
};

/// Runge-Kutta steps `h` [s], the last one cut where the tip meets the ground.
inline CompassStep compass_step(const CompassWalker& w, CompassState y, double h) {
  for (double time = 0.; time < 20.; time += h) {
    const CompassState end = runge_kutta_step(w, y, h);
    if (lands(w, y, end)) {
      double before = 0., after = h;
      for (int i = 0; i < 60; ++i) {
        const double middle = 0.5 * (before + after);
        (swing_clearance(w, runge_kutta_step(w, y, middle)) > 0. ? before : after) = middle;
      }
      const CompassState landed = runge_kutta_step(w, y, after);
      return {landed, after_collision(w, landed), time + after};
    }
    y = end;
  }
  throw std::runtime_error("the compass walker fell");
}

/// The stable cycle that `start` is near to: its step after `steps` others.
inline CompassStep limit_cycle(const CompassWalker& w, CompassState start, double h, int steps) {
  for (int i = 0; i < steps; ++i) start = compass_step(w, start, h).next;
  return compass_step(w, start, h);
}

}  // namespace hookpoint::test_support
