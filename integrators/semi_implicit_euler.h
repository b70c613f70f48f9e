// Semi-implicit (symplectic) Euler: the velocity first, then the position with the new velocity,
//   v1 = v0 + dt a,  q1 = q0 (+) dt v1,
// where a has the forces f of the step's start and the bias forces (centrifugal, Coriolis,
// gyroscopic) of the mean velocity,
//   M(q0) a = f(q0, v0) - c(q0, (v0 + v1)/2).
// c is quadratic in v. Taken at v0 it adds the part z^2 of its energy a step to what nutates by the
// angle z; at the mean velocity a free body keeps w . I w and |I w|, which exp(dt w1), a turn about
// w1, does not change either (docs/decisions/0044-bias-forces-of-the-mean-velocity.md).
// First order, but an undamped vibration keeps its amplitude up to dt = 2/w, at one evaluation of
// forces a step: the default.
#pragma once

#include <cmath>

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
    for (std::size_t i = 0; i < v.size(); ++i) next_v_[i] = v[i] + dt * acceleration_[i];
    if (!take_bias_of_mean_velocity(system, v, dt)) return Status::turns_too_far;
    for (std::size_t i = 0; i < v.size(); ++i) displacement_[i] = dt * next_v_[i];
    system.retract(q, displacement_, next_q_);
    return accept(next_q_, next_v_, q, v);
  }

  /// y(n+1) - 2 y(n) + y(n-1) = -h^2 K y(n) - h C (y(n) - y(n-1)): a motion mu^n y first leaves the
  /// unit circle at mu = -1, where h^2 K + 2 h C has the eigenvalue 4. Of a mode (sqrt(c^2 + 4 k m)
  /// - c)/k; 2/w without damping, 2 m/c without stiffness.
  static constexpr MatrixBound bound{.stiffness = 0.25, .damping = 0.5};

 private:
  /// Brings next_v_ to v1 = v0 + dt a by the fixed-point iteration that puts the mean of the v1 before
  /// into c. Returns whether it converges.
  bool take_bias_of_mean_velocity(System& system, std::span<const double> v, double dt) {
    double change = 0., speed = 0.;  // squared
    int iteration = 0;
    for (; iteration < iterations_for(dt * system.greatest_angular_speed()); ++iteration) {
      for (std::size_t i = 0; i < v.size(); ++i) displacement_[i] = 0.5 * (v[i] + next_v_[i]);
      system.accelerations_with_bias_of(displacement_, acceleration_);
      change = speed = 0.;
      for (std::size_t i = 0; i < v.size(); ++i) {
        const double before = next_v_[i];
        next_v_[i] = v[i] + dt * acceleration_[i];
        change += (next_v_[i] - before) * (next_v_[i] - before);
        speed += next_v_[i] * next_v_[i];
      }
      if (!std::isfinite(speed)) return false;
      if (change <= rounding * rounding * speed) return true;
    }
    return iteration < most_iterations || change <= tolerance * tolerance * speed;
  }

  /// Of an oscillation by the angle z a step, an iteration contracts the error by z/2; 2 m - 1 of
  /// them, or none for m = 0, leave 4 (z/2)^(2 m + 2) of its energy as gain or loss of the step. `turn`, the
  /// angle of the fastest body a step [rad], is the most that z can be.
  static int iterations_for(double turn) {
    int m = 0;
    for (double error = turn * turn; !(error <= energy_error); error *= 0.25 * turn * turn)
      if (2 * ++m - 1 >= most_iterations) return most_iterations;
    return m == 0 ? 0 : 2 * m - 1;
  }

  /// A relative one of 1e-3 in 1e5 steps. Below a turn of 1e-4 there is no iteration: a robot that stands.
  static constexpr double energy_error = 1e-8;
  static constexpr double rounding = 1e-14, tolerance = 1e-6;
  static constexpr int most_iterations = 99;

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
