// Free flight of a rigid body between impacts, about its centre of mass: the exact parabola for the
// translation; for the rotation the angular momentum, exact, and the orientation by fourth-order
// Runge-Kutta.
#pragma once

#include "math/principal_axes.h"

namespace hookpoint::contact {

/// Mass and rotational inertia about the centre of mass, body axes, with what a flight asks of them
/// again and again.
struct FlightInertia {
  FlightInertia(double mass, const Symmetric3d& inertia);

  double mass;                  ///< [kg]
  Symmetric3d inertia;          ///< I [kg m^2]
  Symmetric3d inverse_inertia;  ///< I^-1 [1/(kg m^2)]
  Vector3d moments;             ///< principal [kg m^2]
  Matrix3d R_BP;                ///< body axes from principal ones

  /// I^-1 L, body axes: by principal axes, so that a tiny moment spoils only the rate about its own.
  Vector3d inverse_times(const Vector3d& L) const {
    const Vector3d L_P = transpose_times(R_BP, L);
    return R_BP * Vector3d{L_P.x / moments.x, L_P.y / moments.y, L_P.z / moments.z};
  }
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

/// What no motion of a flight exceeds.
struct MotionBound {
  double angular_speed = 0.;  ///< |w| [rad/s]
  /// |d^3x/dt^3| of a point at unit distance from the centre of mass [1/s^3].
  double jerk = 0.;
};

/// Bounds over the next `duration` [s], from the kinetic energy, which only the torque can raise, and
/// from Euler's equations, component by component along the principal axes: a moment of inertia that
/// is tiny, of a slender body about its own axis, bounds the rate about that axis alone.
MotionBound motion_bound(const FlightInertia& body, const FlightState& state,
                         const FlightLoad& load, double duration);

}  // namespace hookpoint::contact
