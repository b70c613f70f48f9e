// Work over a step of what acts on a robot beside gravity and inertia: its external forces (contacts,
// Forces, pulls, springs of loops) and its joints' torques. What is left of the change of kinetic and
// gravitational energy is numerical (docs/integrators.md, "Numerical energy").
#pragma once

#include <vector>

#include "integrators/stepper.h"
#include "simulation/dts_engine/articulated_robot.h"

namespace hookpoint::simulation {

/// Two quadratures. A method of first order has forces at both ends of a step or flight: half of each
/// over the displacement, which is exact for linear springs and held forces. One of higher order gives
/// weights and nodes of its own, at which the power is summed; joint springs and held drives, whose
/// work the ends give exactly, are left out there.
class WorkMeter {
 public:
  enum class Quadrature { ends, nodes };
  /// Allocates; nothing else does.
  WorkMeter(const ArticulatedRobot& robot, Quadrature quadrature);

  Quadrature quadrature() const { return quadrature_; }
  /// A step begins: its work is 0.
  void begin_step() { work_ = 0.; }
  /// A stretch of motion begins at the robot's present state, whose kinematics and external forces are
  /// in its workspace, and whose joint friction is hooked. O(bodies).
  void begin(const ArticulatedRobot& robot);
  /// The state in the workspace counts for `weight` [s]; by nodes only. O(bodies).
  void add(double weight, const ArticulatedRobot& robot);
  /// It ends at the robot's present state, under the same inputs. O(bodies).
  void end(const ArticulatedRobot& robot);
  /// An impulse on the robot does this work [J].
  void strike(double work) { work_ += work; }

  /// Since the step's start [J].
  double work() const { return work_; }

 private:
  double work_of_bodies(const ArticulatedRobot& robot) const;
  double work_of_joints(const ArticulatedRobot& robot);

  Quadrature quadrature_;
  double work_ = 0.;
  // At the start of the stretch:
  std::vector<dts::BodyMotion<double>> bodies_;
  std::vector<dts::Wrench<double>> external_;
  std::vector<double> joint_positions_, joint_torques_;
  std::vector<double> torques_;
};

/// The one that a method of integration calls for.
WorkMeter::Quadrature quadrature_of(const integrators::StepperDescription& stepper);

}  // namespace hookpoint::simulation
