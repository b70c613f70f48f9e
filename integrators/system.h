// What an integrator sees of a mechanism: a second-order system q' ~ v, v' = a(t, q, v) whose
// positions q may live on a manifold (unit quaternions), while velocities v are plain vectors.
#pragma once

#include <cstddef>
#include <span>

namespace hookpoint::integrators {

enum class Status {
  ok,
  not_finite,  ///< an acceleration, position or velocity is infinite or not a number
  no_step,     ///< an adaptive integrator finds no step that meets its tolerances
  too_long,    ///< an adaptive integrator has spent the evaluations that one step may need
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

  // What only adaptive integrators ask. A system without memory, events and contact keeps these
  // defaults.

  /// Whether `weigh_at` is of use.
  virtual bool has_integrals() const { return false; }
  /// As `weigh`, of a state on the way of an internal step, told before its commit: the nodes of a
  /// quadrature.
  virtual void weigh_at(double /*weight*/, std::span<const double> /*q*/,
                        std::span<const double> /*v*/) {}

  /// An internal step of `dt` [s] has been accepted at (t, q, v), and another follows: what
  /// remembers the past is brought up to date here. Not called for the last internal step, whose
  /// end is the caller's next accepted state, unless it ends at an event.
  virtual void commit(double /*t*/, double /*dt*/, std::span<const double> /*q*/,
                      std::span<const double> /*v*/) {}

  /// After an event's commit: of each event function -1 where it has become negative, +1 where it
  /// has become positive, 0 elsewhere. Its value at the event is 0 but for rounding; which side the
  /// system is on from there is said here.
  virtual void cross_events(std::span<const int> /*directions*/) {}

  /// After an event's commit: `v` as the motion goes on with it. A system may drop from it what the
  /// event has ended (the bristle of a point that has left the ground).
  virtual void begin_anew(std::span<double> /*v*/) {}

  /// Of the velocities the first so many move a position; the rest are states of first order (the
  /// bristles of contacts) that are integrated along.
  virtual std::size_t moving_size() const { return velocity_size(); }
  /// Whether state `i` of those can change before the motion begins anew: what cannot is no
  /// unknown.
  virtual bool evolves(std::size_t /*i*/) const { return true; }

  /// How many event functions there are; the number is the same for life.
  virtual std::size_t event_count() const { return 0; }
  /// The event functions at (t, q, v): the integration stops where one changes sign (a point enters
  /// or leaves the ground), commits and begins anew.
  virtual void event_values(double /*t*/, std::span<const double> /*q*/,
                            std::span<const double> /*v*/, std::span<double> /*values*/) {}

  /// a = a_free + a_contact: the stiff part of `accelerations` at a trial state, and the rest.
  virtual Status split_accelerations(double t, std::span<const double> q, std::span<const double> v,
                                     std::span<double> a_free, std::span<double> a_contact) {
    for (double& a : a_contact) a = 0.;
    return accelerations(Stage::trial, t, q, v, a_free);
  }

  /// Whether the tangent vector `u` has come so far from its origin that it should start at a new
  /// one (half way to where tangent_rate is singular).
  virtual bool far(std::span<const double> /*u*/) const { return false; }

  /// What moves falls into consecutive groups of at most this many, none of which feels another
  /// (the legs of a fixed base): then the Jacobian is a band.
  virtual std::size_t group_size() const { return moving_size(); }
};

}  // namespace hookpoint::integrators
