#include "integrators/rk4.h"

#include <algorithm>

namespace hookpoint::integrators {

RungeKutta4::RungeKutta4(const System& system)
    : u_(system.velocity_size()),
      v_(system.velocity_size()),
      q_(system.position_size()),
      k_u_(system.velocity_size()),
      k_v_(system.velocity_size()),
      sum_u_(system.velocity_size()),
      sum_v_(system.velocity_size()) {}

Status RungeKutta4::trial(System& system, double t, double dt, double reach, double weight,
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

Status RungeKutta4::step(System& system, double t, double dt, std::span<double> q,
                         std::span<double> v) {
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

}  // namespace hookpoint::integrators
