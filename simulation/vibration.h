// A robot that stands, as a linear vibration: its mass matrix, and the springs and dampers of its
// contacts and joints. What the stability bound of an integrator follows from.
#pragma once

#include <Eigen/Core>
#include <string_view>
#include <vector>

#include "dts/impulse_response.h"
#include "simulation/dts_robot.h"

namespace hookpoint::simulation {

/// A contact about its load, world axes: force -K x - C v on the point.
struct ContactSpring {
  dts::BodyPoint<double> point;
  Eigen::Matrix3d stiffness, damping;  ///< symmetric [N/m, N s/m]
};

/// z'' + C z' + K z = 0 in coordinates z with the mass matrix 1; both symmetric.
struct Vibration {
  Eigen::MatrixXd stiffness;  ///< K [1/s^2]
  Eigen::MatrixXd damping;    ///< C [1/s]
  Eigen::MatrixXd joints;     ///< a row a joint: its position over z; a torque moves z by the row
};

/// Of a symmetric matrix.
double largest_eigenvalue(const Eigen::MatrixXd& symmetric);

/// Of a refreshed `robot` about its present posture, at rest: its contacts `springs` and what its
/// joints do by themselves (spring, damper, dry friction below its speed, a stop that is reached).
/// Wired controllers are not in it (loop_stability.h). O(links^3).
Vibration linear_vibration(const DtsRobot& robot, const std::vector<ContactSpring>& springs);

/// The largest step with which the integrator of that name lets no mode of the vibration grow [s];
/// infinity for a vibration without forces and for an adaptive integrator. Motions that nothing
/// resists do not count.
double largest_stable_step(std::string_view integrator, const Vibration& vibration);

}  // namespace hookpoint::simulation
