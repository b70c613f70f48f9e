// Euler's method: position and velocity both advance by their rates at the start of the step. First
// order, and it feeds energy into every undamped vibration (stability_bound.h).
#pragma once

#include "integrators/stepper.h"

namespace hookpoint::integrators {

class ExplicitEuler final : public Stepper {
 public:
  explicit ExplicitEuler(const System& system);
  /// v1 = v0 + dt a0,  q1 = q0 (+) dt v0.
  Status step(System& system, double t, double dt, std::span<double> q,
              std::span<double> v) override;

 private:
  std::vector<double> acceleration_, displacement_, next_q_, next_v_;
};

}  // namespace hookpoint::integrators
