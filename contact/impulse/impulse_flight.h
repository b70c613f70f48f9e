// Free flight of a rigid body between impacts, about its centre of mass: the exact parabola for the
// translation; for the rotation the angular momentum, exact, and the orientation by fourth-order
// Runge-Kutta.
#pragma once

#include "math/rotation.h"

namespace hookpoint::contact {

/// Mass and rotational inertia about the centre of mass, body axes, with what a flight asks of them
/// again and again.
struct FlightInertia {
  FlightInertia(double mass, const Symmetric3d& inertia);

  double mass;                  ///< [kg]
  Symmetric3d inertia;          ///< I [kg m^2]
  Symmetric3d inverse_inertia;  ///< I^-1
  double least_inertia;  ///< a lower bound of the principal moments, within a factor of 3 [kg m^2]
  double greatest_inertia;  ///< an upper bound of them, likewise
};

/// World axes, SI.
struct FlightState {
  Vector3d center_of_mass;    ///< c [m]
  Quaterniond orientation;    ///< R_WB
  Vector3d velocity;          ///< dc/dt [m/s]
  Vector3d angular_momentum;  ///< L about the centre of mass [kg m^2/s]
};

/// Constant over a step, world axes.
struct FlightLoad {
  Vector3d acceleration;  ///< of the centre of mass, gravity included [m/s^2]
  Vector3d torque;        ///< about the centre of mass [N m]
};

/// w = R I^-1 R^T L, world axes [rad/s].
Vector3d angular_velocity(const FlightInertia& body, const FlightState& state);

/// The state `duration` [s] later. The local error of the orientation is O((|w| duration)^5); L is
/// exact.
FlightState fly(const FlightInertia& body, const FlightState& state, const FlightLoad& load,
                double duration);

/// A bound of |w| over the next `duration`: from the kinetic energy, which only the torque can
/// raise [rad/s].
double angular_speed_bound(const FlightInertia& body, const FlightState& state,
                           const FlightLoad& load, double duration);

/// A bound of |d^3x/dt^3| of a point at unit distance from the centre of mass while |w| <=
/// `angular_speed` [1/s^3].
double jerk_bound(const FlightInertia& body, const FlightLoad& load, double angular_speed);

}  // namespace hookpoint::contact
