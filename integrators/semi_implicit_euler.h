// Semi-implicit (symplectic) Euler: the velocity first, then the position with the new velocity,
//   v1 = v0 + dt a0,  q1 = q0 (+) dt v1.
// First order, but an undamped vibration keeps its amplitude up to dt = 2/w, at one evaluation a
// step: the default.
#pragma once

#include "integrators/stepper.h"

namespace hookpoint::integrators {

class SemiImplicitEuler : public Stepper {
 public:
  explicit SemiImplicitEuler(const System& system)
      : acceleration_(system.velocity_size()),
        displacement_(system.velocity_size()),
        next_q_(system.position_size()),
        next_v_(system.velocity_size()) {}

  Status step(System& system, double t, double dt, std::span<double> q,
              std::span<double> v) override {
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

  /// y(n+1) - 2 y(n) + y(n-1) = -h^2 K y(n) - h C (y(n) - y(n-1)): a motion mu^n y first leaves the
  /// unit circle at mu = -1, where h^2 K + 2 h C has the eigenvalue 4. Of a mode (sqrt(c^2 + 4 k m)
  /// - c)/k; 2/w without damping, 2 m/c without stiffness.
  static constexpr MatrixBound bound{.stiffness = 0.25, .damping = 0.5};

 private:
  std::vector<double> acceleration_, displacement_, next_q_, next_v_;
};

inline constexpr StepperDescription semi_implicit_euler{
    .name = "semi_implicit_euler",
    .order = 1,
    .evaluations = 1,
    .summary = "position by the new velocity; keeps vibrations bounded up to dt = 2/w",
    .make = make_fixed_step<SemiImplicitEuler>,
    .stability = SemiImplicitEuler::bound,
    .moves_with_new_velocity = true};

}  // namespace hookpoint::integrators
