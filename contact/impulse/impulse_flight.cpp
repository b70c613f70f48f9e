#include "contact/impulse/impulse_flight.h"

#include <algorithm>
#include <array>
#include <cmath>

namespace hookpoint::contact {
namespace {

using AlongAxes = std::array<double, 3>;  // along the principal axes

double size(const AlongAxes& a) { return std::hypot(a[0], a[1], a[2]); }

Quaterniond advanced(const Quaterniond& q, double h, const Quaterniond& rate) {
  return {q.w + h * rate.w, q.x + h * rate.x, q.y + h * rate.y, q.z + h * rate.z};
}

// dq/dt = q (0, w_B)/2 with w_B = I^-1 R^T L.
Quaterniond orientation_rate(const FlightInertia& body, const Quaterniond& q, const Vector3d& L) {
  const Vector3d w = body.inverse_times(rotate(conjugate(normalized(q)), L));
  return q * Quaterniond{0., 0.5 * w.x, 0.5 * w.y, 0.5 * w.z};
}

}  // namespace

FlightInertia::FlightInertia(double mass_, const Symmetric3d& inertia_)
    : mass(mass_), inertia(inertia_) {
  const PrincipalAxes principal = principal_axes(inertia_);
  moments = principal.moments;
  R_BP = rotation_matrix(principal.orientation);
  inverse_inertia =
      rotate(R_BP, Symmetric3d{1. / moments.x, 1. / moments.y, 1. / moments.z, 0., 0., 0.});
}

Vector3d angular_velocity(const FlightInertia& body, const FlightState& state) {
  const Vector3d L_B = rotate(conjugate(state.orientation), state.angular_momentum);
  return rotate(state.orientation, body.inverse_times(L_B));
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

MotionBound motion_bound(const FlightInertia& body, const FlightState& state,
                         const FlightLoad& load, double duration) {
  const AlongAxes I{body.moments.x, body.moments.y, body.moments.z};
  const Vector3d w = angular_velocity(body, state);
  const Vector3d w_P = transpose_times(body.R_BP, rotate(conjugate(state.orientation), w));
  const AlongAxes start{std::abs(w_P.x), std::abs(w_P.y), std::abs(w_P.z)};
  const double torque = norm(load.torque);
  const auto gyration = [&](std::size_t i) { return std::abs(I[(i + 1) % 3] - I[(i + 2) % 3]); };

  // sqrt(2 E) and its growth: d sqrt(2 E)/dt <= |tau|/sqrt(I_min).
  const double energy = std::sqrt(std::max(0., dot(state.angular_momentum, w))) +
                        duration * torque / std::sqrt(*std::min_element(I.begin(), I.end()));
  AlongAxes speed{};  // bounds of |w_i|
  for (std::size_t i = 0; i < 3; ++i) speed[i] = energy / std::sqrt(I[i]);
  // Of I_i dw_i = (I_j - I_k) w_j w_k + tau_i, from bounds that hold a bound that holds.
  const auto acceleration = [&](std::size_t i) {
    return (gyration(i) * speed[(i + 1) % 3] * speed[(i + 2) % 3] + torque) / I[i];
  };
  constexpr int rounds = 3;
  for (int round = 0; round < rounds; ++round) {
    for (std::size_t i = 0; i < 3; ++i)
      speed[i] = std::min(speed[i], start[i] + duration * acceleration(i));
  }
  const AlongAxes alphas{acceleration(0), acceleration(1), acceleration(2)};
  const double speed_all = size(speed);
  // The derivative of Euler's equations in body axes, where tau turns with -w.
  AlongAxes alpha_rates{};
  for (std::size_t i = 0; i < 3; ++i) {
    const std::size_t j = (i + 1) % 3, k = (i + 2) % 3;
    alpha_rates[i] =
        (gyration(i) * (alphas[j] * speed[k] + speed[j] * alphas[k]) + torque * speed_all) / I[i];
  }
  // d^3x/dt^3 = (dalpha/dt) x r + 2 alpha x (w x r) + w x (alpha x r) + w x (w x (w x r)); in world
  // axes dalpha/dt has w x alpha as well.
  const double alpha = size(alphas);
  return {speed_all,
          size(alpha_rates) + 4. * alpha * speed_all + speed_all * speed_all * speed_all};
}

}  // namespace hookpoint::contact
