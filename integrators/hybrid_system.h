// What an integrator that chooses its own steps asks of a mechanism beyond integrators/system.h:
// memory that changes on the way, events where its accelerations jump, states of first order, and
// which part of it is stiff. A hybrid system: smooth from event to event.
#pragma once

#include "integrators/system.h"

namespace hookpoint::integrators {

/// The defaults are those of a system without memory, events and contact.
class HybridSystem : public System {
 public:
  // Memory and integrals.

  /// An internal step has been accepted at (t, q, v), and another follows: what remembers the past
  /// is brought up to date here. Not called for the last internal step, whose end is the caller's
  /// next accepted state, unless it ends at an event.
  virtual void commit(double /*t*/, std::span<const double> /*q*/, std::span<const double> /*v*/) {}
  /// Whether `weigh_at` is of use.
  virtual bool has_integrals() const { return false; }
  /// As `weigh`, of a state on the way of an internal step, called before its commit: the nodes of
  /// a quadrature.
  virtual void weigh_at(double /*weight*/, std::span<const double> /*q*/,
                        std::span<const double> /*v*/) {}

  // Events.

  /// How many event functions there are; the number is the same for life.
  virtual std::size_t event_count() const { return 0; }
  /// The event functions at (t, q, v): the integration stops where one changes sign (a point enters
  /// or leaves the ground), commits and restarts.
  virtual void event_values(double /*t*/, std::span<const double> /*q*/,
                            std::span<const double> /*v*/, std::span<double> /*values*/) {}
  /// After an event's commit: of each event function -1 where it has become negative, +1 where it
  /// has become positive, 0 elsewhere. Its value at the event is 0 but for rounding; which side the
  /// system is on from there is said here.
  virtual void cross_events(std::span<const int> /*directions*/) {}
  /// After an event's commit: `v` with which the motion continues. A system may drop from it what
  /// the event has ended (the bristle of a point that has left the ground).
  virtual void reinitialize(std::span<double> /*v*/) {}

  // The unknowns.

  /// Of the velocities the first so many move a position; the rest are states of first order (the
  /// bristles of contacts) that are integrated along.
  virtual std::size_t dof_count() const { return velocity_size(); }
  /// Whether state `i` of those can change before the motion is reinitialized: what cannot is no
  /// unknown.
  virtual bool is_active_state(std::size_t /*i*/) const { return true; }
  /// Degrees of freedom fall into consecutive groups of at most this many, none of which feels
  /// another (the legs of a fixed base): then the Jacobian is a band.
  virtual std::size_t jacobian_block() const { return dof_count(); }
  /// Whether the tangent vector `u` has come so far from its origin that it should start at a new
  /// one (half way to where tangent_rate is singular).
  virtual bool chart_exhausted(std::span<const double> /*u*/) const { return false; }

  /// a = a_free + a_contact: the stiff part of `accelerations` at a trial state, and the rest.
  virtual Status split_accelerations(double t, std::span<const double> q, std::span<const double> v,
                                     std::span<double> a_free, std::span<double> a_contact) {
    for (double& a : a_contact) a = 0.;
    return accelerations(Stage::trial, t, q, v, a_free);
  }
};

}  // namespace hookpoint::integrators
