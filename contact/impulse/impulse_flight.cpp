#include "contact/impulse/impulse_flight.h"

namespace hookpoint::contact {
namespace {

double trace(const Symmetric3d& m) { return m.xx + m.yy + m.zz; }

Quaterniond advanced(const Quaterniond& q, double h, const Quaterniond& rate) {
  return {q.w + h * rate.w, q.x + h * rate.x, q.y + h * rate.y, q.z + h * rate.z};
}

// dq/dt = q (0, w_B)/2 with w_B = I^-1 R^T L.
Quaterniond orientation_rate(const FlightInertia& body, const Quaterniond& q, const Vector3d& L) {
  const Vector3d w = body.inverse_inertia * rotate(conjugate(normalized(q)), L);
  return q * Quaterniond{0., 0.5 * w.x, 0.5 * w.y, 0.5 * w.z};
}

}  // namespace

FlightInertia::FlightInertia(double mass_, const Symmetric3d& inertia_)
    : mass(mass_),
      inertia(inertia_),
      inverse_inertia(inverse(inertia_)),
      least_inertia(1. / trace(inverse_inertia)),
      greatest_inertia(trace(inertia_)) {}

Vector3d angular_velocity(const FlightInertia& body, const FlightState& state) {
  const Vector3d L_B = rotate(conjugate(state.orientation), state.angular_momentum);
  return rotate(state.orientation, body.inverse_inertia * L_B);
}

FlightState fly(const FlightInertia& body, const FlightState& state, const FlightLoad& load,
                double h) {
  const auto L = [&](double t) { return state.angular_momentum + t * load.torque; };
  const Quaterniond& q = state.orientation;
  const Quaterniond k1 = orientation_rate(body, q, L(0.));
  const Quaterniond k2 = orientation_rate(body, advanced(q, 0.5 * h, k1), L(0.5 * h));
  const Quaterniond k3 = orientation_rate(body, advanced(q, 0.5 * h, k2), L(0.5 * h));
  const Quaterniond k4 = orientation_rate(body, advanced(q, h, k3), L(h));
  const Quaterniond rise = advanced(advanced(advanced(k1, 2., k2), 2., k3), 1., k4);
  return {state.center_of_mass + h * state.velocity + 0.5 * h * h * load.acceleration,
          normalized(advanced(q, h / 6., rise)), state.velocity + h * load.acceleration, L(h)};
}

double angular_speed_bound(const FlightInertia& body, const FlightState& state,
                           const FlightLoad& load, double duration) {
  // 2 E = L . w >= I_min |w|^2, and d sqrt(2 E)/dt <= |tau|/sqrt(I_min).
  const double energy = max(0., dot(state.angular_momentum, angular_velocity(body, state)));
  const double least = sqrt(body.least_inertia);
  return (sqrt(energy) + duration * norm(load.torque) / least) / least;
}

double jerk_bound(const FlightInertia& body, const FlightLoad& load, double w) {
  // From I dw = tau - w x I w and its derivative in body axes (tau turns with -w there), then
  // d^3x/dt^3 = (dalpha/dt) x r + 2 alpha x (w x r) + w x (alpha x r) + w x (w x (w x r)).
  const double torque = norm(load.torque);
  const double least = body.least_inertia, greatest = body.greatest_inertia;
  const double alpha = (torque + 0.5 * (greatest - least) * w * w) / least;
  const double alpha_rate = (torque * w + 2. * greatest * w * alpha) / least + w * alpha;
  return alpha_rate + 3. * alpha * w + w * w * w;
}

}  // namespace hookpoint::contact
