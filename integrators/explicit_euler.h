// Euler's method: position and velocity both advance by their rates at the start of the step,
//   v1 = v0 + dt a0,  q1 = q0 (+) dt v0.
// First order, and it feeds energy into every undamped vibration.
#pragma once

#include <cmath>
#include <limits>

#include "integrators/stepper.h"

namespace hookpoint::integrators {

class ExplicitEuler final : public Stepper {
 public:
  explicit ExplicitEuler(const System& system)
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
      displacement_[i] = dt * v[i];
      next_v_[i] = v[i] + dt * acceleration_[i];
    }
    system.retract(q, displacement_, next_q_);
    return accept(next_q_, next_v_, q, v);
  }

  /// |1 + lambda dt| = 1 at dt = -2 Re lambda/|lambda|^2: of a mode c/k for zeta = c/(2 sqrt(k m))
  /// < 1 (0 without damping: never stable), 4 m/(c + sqrt(c^2 - 4 k m)) above [s].
  static double largest_step(std::complex<double> eigenvalue) {
    // Decay below round-off of the modulus is none.
    constexpr double least_decay = 1e-12;
    const double modulus = std::abs(eigenvalue);
    if (modulus == 0.) return std::numeric_limits<double>::infinity();
    const double decay = -eigenvalue.real() / modulus;
    return decay > least_decay ? 2. * decay / modulus : 0.;
  }

 private:
  std::vector<double> acceleration_, displacement_, next_q_, next_v_;
};

inline constexpr StepperDescription explicit_euler{
    .name = "explicit_euler",
    .order = 1,
    .evaluations = 1,
    .summary = "position by the old velocity; unstable on undamped springs",
    .make = make_fixed_step<ExplicitEuler>,
    .stability = EigenvalueBound{ExplicitEuler::largest_step}};

}  // namespace hookpoint::integrators
