// Semi-implicit (symplectic) Euler: the velocity first, then the position with the new velocity.
// First order, but an undamped vibration keeps its amplitude up to dt = 2/w, at one evaluation a
// step: the default.
#pragma once

#include "integrators/stepper.h"

namespace hookpoint::integrators {

class SemiImplicitEuler final : public Stepper {
 public:
  explicit SemiImplicitEuler(const System& system);
  /// v1 = v0 + dt a0,  q1 = q0 (+) dt v1.
  Status step(System& system, double t, double dt, std::span<double> q,
              std::span<double> v) override;

 private:
  std::vector<double> acceleration_, displacement_, next_q_, next_v_;
};

}  // namespace hookpoint::integrators
