// Energy, mass and centre of mass of a robot, from what every engine publishes.
#pragma once

#include <span>

#include "simulation/engine_interface/engine.h"

namespace hookpoint::simulation {

/// Sums over the bodies of a robot that move; a fixed base counts for nothing.
struct RobotSums {
  double kinetic_energy = 0.;    ///< [J]
  double potential_energy = 0.;  ///< of gravity, zero at the world's origin [J]
  Vector3d center_of_mass;       ///< world axes [m]
  Vector3d center_velocity;      ///< of the same [m/s]
  double mass = 0.;              ///< [kg]
};

/// T = sum (m v_c^2 + w.I w + I_r q'^2)/2, V = -sum m g.c. `bodies` and `joints` are the robot's own.
/// O(bodies).
RobotSums robot_sums(const RobotSpec& robot, const Vector3d& gravity,
                     std::span<const BodyState> bodies, std::span<const JointState> joints);

}  // namespace hookpoint::simulation
