// What a controller of the whole body asks of a robot at any published state, whatever engine made
// it: M v' + h = S tau + J^T f, its parts, and the motion about the state as linear dynamics.
#pragma once

#include <cstddef>
#include <string>
#include <vector>

#include "dts/jacobian.h"
#include "dts/state.h"
#include "simulation/engine_interface/engine.h"
#include "simulation/experiment/experiment.h"

namespace hookpoint::simulation {

/// One of v: angular velocity and velocity of a mobile base's origin, world axes (of a planar base
/// those in its plane), then the joints' rates, chain by chain.
struct VelocityCoordinate {
  std::string trail;  ///< "walker.base.velocity.x", "walker.leg.thigh.rate"
  std::string unit;   ///< rad/s or m/s
};

/// x' = A x + B u, x the displacements of the coordinates (the base's turn as a rotation vector,
/// world axes) and then their rates, u the drives' torques.
struct LinearisedRobot {
  std::vector<double> A;  ///< 2 n x 2 n, row by row
  std::vector<double> B;  ///< 2 n x joints
};

/// Robot `robot` of the experiment at one state. Matrices are given row by row; n coordinates.
class ControllerTerms {
 public:
  ControllerTerms(const Experiment& experiment, std::size_t robot, const WorldState& state);
  /// At the experiment's initial state.
  ControllerTerms(const Experiment& experiment, std::size_t robot);

  const std::string& robot() const { return experiment_->robots[robot_].name; }
  const std::vector<VelocityCoordinate>& coordinates() const { return coordinates_; }
  /// Names of the bodies without the robot's: "base", "leg.thigh".
  const std::vector<std::string>& bodies() const { return bodies_; }
  /// M, n x n [kg m^2, kg m, kg]: T = v.M v / 2. O(links^2).
  std::vector<double> mass_matrix() const;
  /// h, n: what velocities and gravity take [N m, N]; neither joints' own springs, dampers and
  /// friction nor the ground are in it. O(links).
  std::vector<double> bias_forces() const;
  /// The part of h that is there at rest: -m J_c^T g.
  std::vector<double> gravity_forces() const;
  /// Mass [kg], place [m] and Jacobian (3 x n) of the centre of mass of all that moves.
  const dts::CenterOfMass& center_of_mass() const { return center_; }
  /// 6 x n: angular velocity of the body [rad/s] and velocity of its point `point` (body axes [m])
  /// [m/s], world axes, of unit rates.
  std::vector<double> jacobian(std::size_t body, const Vector3d& point) const;
  /// About the state, under drives that give `torques` (one a joint [N m, N]), by central
  /// differences of the accelerations: a relative error near 1e-9 where these are smooth. The
  /// joints' own springs, dampers and friction are in it, the ground is not.
  LinearisedRobot linearised(const std::vector<double>& torques) const;

 private:
  ControllerTerms(const Experiment& experiment, std::size_t robot, dts::State<double> state);
  /// Of rows over all of the engine's velocities the columns that are free.
  std::vector<double> in_free(const std::vector<double>& rows) const;

  const Experiment* experiment_;
  std::size_t robot_;
  std::vector<std::size_t> free_;  ///< of the engine's velocities: those of `coordinates_`
  std::vector<VelocityCoordinate> coordinates_;
  std::vector<std::string> bodies_;
  dts::Model<double> model_;
  dts::State<double> state_;
  dts::Workspace<double> workspace_;
  dts::CompositeBodies composite_;
  dts::CenterOfMass center_;
};

}  // namespace hookpoint::simulation
