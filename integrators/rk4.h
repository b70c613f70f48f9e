// The classical Runge-Kutta method on the configuration manifold: the step is taken in the tangent
// coordinates u of q = q0 (+) u, where u' = tangent_rate(u, v) is an ordinary equation, so fourth
// order holds for rotations as well (Munthe-Kaas 1999, High order Runge-Kutta methods on
// manifolds). With y = (u, v), y' = F(t, y):
//   k1 = F(t, y0), k2 = F(t + dt/2, y0 + dt/2 k1), k3 = F(t + dt/2, y0 + dt/2 k2),
//   k4 = F(t + dt, y0 + dt k3),  y1 = y0 + dt (k1 + 2 k2 + 2 k3 + k4)/6.
#pragma once

#include <algorithm>
#include <cmath>
#include <limits>

#include "integrators/stepper.h"
#include "math/bisect.h"

namespace hookpoint::integrators {

class RungeKutta4 final : public Stepper {
 public:
  explicit RungeKutta4(const System& system)
      : u_(system.velocity_size()),
        v_(system.velocity_size()),
        q_(system.position_size()),
        k_u_(system.velocity_size()),
        k_v_(system.velocity_size()),
        sum_u_(system.velocity_size()),
        sum_v_(system.velocity_size()) {}

  Status step(System& system, double t, double dt, std::span<double> q,
              std::span<double> v) override {
    Status status = evaluate(system, Stage::first, t, q, v, k_v_);
    if (status != Status::ok) return status;
    system.weigh(dt / 6.);
    std::copy(v.begin(), v.end(), k_u_.begin());  // at u = 0 the tangent rate is v itself
    sum_u_ = k_u_;
    sum_v_ = k_v_;

    status = trial(system, t + 0.5 * dt, dt, 0.5 * dt, 2., q, v);
    if (status != Status::ok) return status;
    status = trial(system, t + 0.5 * dt, dt, 0.5 * dt, 2., q, v);
    if (status != Status::ok) return status;
    status = trial(system, t + dt, dt, dt, 1., q, v);
    if (status != Status::ok) return status;

    for (std::size_t i = 0; i < v.size(); ++i) {
      u_[i] = dt / 6. * sum_u_[i];
      v_[i] = v[i] + dt / 6. * sum_v_[i];
    }
    system.retract(q, u_, q_);
    return accept(q_, v_, q, v);
  }

  /// Where |R(lambda dt)| first exceeds 1, R(z) = 1 + z + z^2/2 + z^3/6 + z^4/24: of a mode 2
  /// sqrt(2)/w without damping, 2.785.../|lambda| for real eigenvalues [s].
  static double largest_step(std::complex<double> eigenvalue) {
    constexpr double least_growth = 1e-12;
    const double modulus = std::abs(eigenvalue);
    if (modulus == 0.) return std::numeric_limits<double>::infinity();
    const std::complex<double> direction = eigenvalue / modulus;
    // What grows by itself grows with every step that is short enough. Growth below round-off of
    // the modulus is none.
    if (direction.real() > least_growth) return 0.;
    const auto unstable = [&](double r) {
      const std::complex<double> z = r * direction;
      return std::abs(1. + z * (1. + z / 2. * (1. + z / 3. * (1. + z / 4.)))) > 1.;
    };
    // The region |R| <= 1 ends between 2.6 and 3.4 from the origin in the left half plane; march
    // out, then bisect. Below 1 an undamped mode's |R| = 1 - O(|z|^6) is too near 1 to be compared.
    double low = 1.;
    double high = low;
    while (!unstable(high)) {
      low = high;
      high += 0.01;
    }
    return bisect([&](double r) { return unstable(r) ? 1. : -1.; }, low, high) / modulus;
  }

 private:
  /// k = F at y0 + reach (k of the stage before), and sum += weight k; `reach` and `dt` [s].
  Status trial(System& system, double t, double dt, double reach, double weight,
               std::span<const double> q, std::span<const double> v) {
    for (std::size_t i = 0; i < v.size(); ++i) {
      u_[i] = reach * k_u_[i];
      v_[i] = v[i] + reach * k_v_[i];
    }
    system.retract(q, u_, q_);
    system.tangent_rate(u_, v_, k_u_);
    const Status status = evaluate(system, Stage::trial, t, q_, v_, k_v_);
    system.weigh(weight * dt / 6.);
    for (std::size_t i = 0; i < v.size(); ++i) {
      sum_u_[i] += weight * k_u_[i];
      sum_v_[i] += weight * k_v_[i];
    }
    return status;
  }

  std::vector<double> u_, v_, q_;      // the trial state
  std::vector<double> k_u_, k_v_;      // rates of the latest stage
  std::vector<double> sum_u_, sum_v_;  // k1 + 2 k2 + 2 k3 + k4
};

inline constexpr StepperDescription rk4{
    .name = "rk4",
    .order = 4,
    .evaluations = 4,
    .summary = "classical Runge-Kutta, fourth order on rotations as well",
    .make = make_fixed_step<RungeKutta4>,
    .stability = EigenvalueBound{RungeKutta4::largest_step}};

}  // namespace hookpoint::integrators
