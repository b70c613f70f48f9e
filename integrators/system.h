// What an integrator sees of a mechanism: a second-order system q' ~ v, v' = a(t, q, v) whose
// positions q may live on a manifold (unit quaternions), while velocities v are plain vectors.
#pragma once

#include <cstddef>
#include <span>

namespace hookpoint::integrators {

enum class Status {
  ok,
  not_finite,     ///< an acceleration, position or velocity is infinite or not a number
  turns_too_far,  ///< a body turns so far in a step that its bias forces cannot be found
  no_step,        ///< an adaptive integrator finds no step that meets its tolerances
  too_long,       ///< an adaptive integrator has spent the evaluations that one step may need
};

/// Which evaluation within a step this is. `first` is at the accepted state (t, q, v) that the step
/// starts from, and comes exactly once a step, before all others: what remembers the past (contact
/// hooks) has been committed there, and the system may know this state already. `trial` is at a
/// state that may never be visited: the system evaluates it from the committed memory and leaves
/// that memory alone.
enum class Stage { first, trial };

class System {
 public:
  virtual ~System() = default;
  /// Numbers that store a position q (7 + joints for a mobile base) and a velocity v (6 + joints).
  virtual std::size_t position_size() const = 0;
  virtual std::size_t velocity_size() const = 0;

  /// a = dv/dt at time `t` [s], position `q` and velocity `v`. Anything but `ok` ends the step.
  virtual Status accelerations(Stage stage, double t, std::span<const double> q,
                               std::span<const double> v, std::span<double> a) = 0;

  /// Greatest angular velocity of a rigid body at the state evaluated last [rad/s]; 0 where the
  /// bias forces c(q, v) of M v' + c = f (centrifugal, Coriolis, gyroscopic) do not depend on v.
  virtual double greatest_angular_speed() const { return 0.; }
  /// a = M^-1 (f - c(q, v)) with the position q and the forces f of the evaluation before, and the
  /// bias forces of the velocity `v`. `a` comes as that evaluation left it; states of first order in
  /// it stay.
  virtual void accelerations_with_bias_of(std::span<const double> /*v*/, std::span<double> /*a*/) {}

  /// From now on `accelerations` has the springs and dampers of joints as they are at the end of a
  /// step of `h` [s]: with those, -K_j q - C_j v, and all else in f it solves
  /// (M + h C_j + h^2 K_j) a = f - K_j (q + h v) - C_j v. 0: as they are at (q, v).
  virtual void take_joints_at_end_of(double /*h*/) {}

  /// q_out = q0 (+) u: the position reached from q0 along the tangent vector `u` (velocity_size
  /// numbers): q0 + u in a vector space, exp(u) q0 for a rotation in world axes. `q_out` does not
  /// alias `q0`.
  virtual void retract(std::span<const double> q0, std::span<const double> u,
                       std::span<double> q_out) const = 0;

  /// du = the rate of u for which q0 (+) u moves with velocity `v`: v itself in a vector space,
  /// dexp_u^-1 v for a rotation (rotation_rate.h). It is what keeps RK4 at fourth order on
  /// rotations (Munthe-Kaas 1999).
  virtual void tangent_rate(std::span<const double> u, std::span<const double> v,
                            std::span<double> du) const = 0;

  /// What was evaluated last counts for `weight` [s] of the step in integrals over it: b_i dt of a
  /// stage of a Runge-Kutta method. The weights of a step add up to dt.
  virtual void weigh(double /*weight*/) {}
};

}  // namespace hookpoint::integrators
