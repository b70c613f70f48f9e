// What the forces do at an experiment's initial state: no time passes.
#pragma once

#include <optional>
#include <string>
#include <vector>

#include "simulation/experiment/experiment.h"

namespace hookpoint::simulation {

struct ChainDynamics {
  std::string name;                         ///< its trail below the robot
  std::string carrier;                      ///< that of the body that it hangs on: "base"
  std::vector<double> joint_accelerations;  ///< [rad/s^2 or m/s^2]
  Vector3d hip_force, hip_moment;           ///< ON what carries it, at the hip, world axes [N, N m]
};

/// A boundary point inside the ground.
struct ContactReport {
  std::string body;   ///< trail: "block.base"
  double depth = 0.;  ///< [m]
  Vector3d position;  ///< world [m]
  Vector3d normal;
  Vector3d force;  ///< on the robot, world axes [N]
};

/// World axes, SI; momentum and energy about the world's origin, V = -sum m g.c.
struct RobotDynamics {
  std::string name;
  Vector3d base_acceleration;  ///< of the base origin; free fall: gravity
  Vector3d base_angular_acceleration;
  std::vector<ChainDynamics> chains;
  double kinetic_energy = 0., potential_energy = 0.;
  Vector3d linear_momentum, angular_momentum;
  std::vector<ContactReport> contacts;
};

struct DynamicsReport {
  std::string world;
  std::vector<RobotDynamics> robots;
  std::optional<double>
      largest_stable_step;  ///< [s]; none without contact forces (impulse laws, no ground)
};

/// Always by the DTS engine, whatever engine the experiment names. Under an impulse law, which has
/// no forces, the ground is left out. Throws ExperimentError where a number overflows.
DynamicsReport evaluate_dynamics(const Experiment& experiment);

}  // namespace hookpoint::simulation
