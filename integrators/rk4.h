// The classical Runge-Kutta method on the configuration manifold: the step is taken in the tangent
// coordinates u of q = q0 (+) u, where u' = tangent_rate(u, v) is an ordinary equation, so fourth
// order holds for rotations as well (Munthe-Kaas 1999, High order Runge-Kutta methods on
// manifolds).
#pragma once

#include "integrators/stepper.h"

namespace hookpoint::integrators {

class RungeKutta4 final : public Stepper {
 public:
  explicit RungeKutta4(const System& system);
  /// With y = (u, v), y' = F(t, y):  k1 = F(t, y0), k2 = F(t + dt/2, y0 + dt/2 k1), k3 = F(t +
  /// dt/2, y0 + dt/2 k2), k4 = F(t + dt, y0 + dt k3),  y1 = y0 + dt (k1 + 2 k2 + 2 k3 + k4)/6.
  Status step(System& system, double t, double dt, std::span<double> q,
              std::span<double> v) override;

 private:
  /// k = F at y0 + reach (k of the stage before), and sum += weight k; `reach` and `dt` [s].
  Status trial(System& system, double t, double dt, double reach, double weight,
               std::span<const double> q, std::span<const double> v);

  std::vector<double> u_, v_, q_;      // the trial state
  std::vector<double> k_u_, k_v_;      // rates of the latest stage
  std::vector<double> sum_u_, sum_v_;  // k1 + 2 k2 + 2 k3 + k4
};

}  // namespace hookpoint::integrators
