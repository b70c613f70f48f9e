// Semi-implicit Euler whose joint springs and dampers act as they are at the step's end,
//   (M + dt C_j + dt^2 K_j) (v1 - v0) = dt (f - K_j (q0 + dt v0) - C_j v0),  q1 = q0 (+) dt v1,
// where f is all else and K_j, C_j are diagonal: one number more on each joint's inertia in the
// recursion (the linearly implicit Euler method of Hairer & Wanner 1996, IV.7, for the joints
// alone). Stiff fingers bear large steps; vibrations of a joint's spring are damped: one of w by
// w^2 dt/2 a second.
#pragma once

#include "integrators/semi_implicit_euler.h"

namespace hookpoint::integrators {

class ImplicitJoints final : public SemiImplicitEuler {
 public:
  using SemiImplicitEuler::SemiImplicitEuler;

  Status step(System& system, double t, double dt, std::span<double> q,
              std::span<double> v) override {
    system.take_joints_at_end_of(dt);
    return SemiImplicitEuler::step(system, t, dt, q, v);
  }

  /// With mu^n y as in SemiImplicitEuler: at mu = -1 the joints' springs pull against the others,
  /// 4 + h^2 K_j + 2 h C_j = h^2 K + 2 h C.
  static constexpr MatrixBound bound{.stiffness = 0.25, .damping = 0.5, .joints = -1.};
};

inline constexpr StepperDescription implicit_joints{
    .name = "implicit_joints",
    .order = 1,
    .evaluations = 1,
    .summary =
        "semi_implicit_euler with joint springs and dampers at the step's end, which bound "
        "no step",
    .make = make_fixed_step<ImplicitJoints>,
    .stability = ImplicitJoints::bound,
    .moves_with_new_velocity = true,
    .implicit_joints = true};

}  // namespace hookpoint::integrators
