#include "integrators/semi_implicit_euler.h"

namespace hookpoint::integrators {

SemiImplicitEuler::SemiImplicitEuler(const System& system)
    : acceleration_(system.velocity_size()),
      displacement_(system.velocity_size()),
      next_q_(system.position_size()),
      next_v_(system.velocity_size()) {}

Status SemiImplicitEuler::step(System& system, double t, double dt, std::span<double> q,
                               std::span<double> v) {
  const Status status = evaluate(system, Stage::first, t, q, v, acceleration_);
  if (status != Status::ok) return status;
  system.weigh(dt);
  for (std::size_t i = 0; i < v.size(); ++i) {
    next_v_[i] = v[i] + dt * acceleration_[i];
    displacement_[i] = dt * next_v_[i];
  }
  system.retract(q, displacement_, next_q_);
  return accept(next_q_, next_v_, q, v);
}

}  // namespace hookpoint::integrators
