// One robot of the DTS engine: its dynamics, its contact memory, and the second-order system that a
// stepper integrates.
#pragma once

#include <span>
#include <vector>

#include "contact/force_law.h"
#include "contact/terrain.h"
#include "dts/joint_forces.h"
#include "dts/model.h"
#include "dts/state.h"
#include "dts/workspace.h"
#include "integrators/stepper.h"
#include "simulation/engine.h"

namespace hookpoint::simulation {

/// The part of a RobotSpec that the engine's recursions read.
dts::RobotDescription describe_robot(const RobotSpec& robot);
/// The robot's initial state. Joint positions add to theta (revolute) or d (prismatic).
dts::State<double> initial_state(const RobotSpec& robot);

/// A boundary point and what the law made of it at the state that was refreshed last.
struct ContactPoint {
  std::size_t body = 0;               ///< 0 the base, then links chain by chain
  Vector3d p_BP;                      ///< body axes [m]
  contact::Memory<double> before;     ///< what `committed` was before the last step, to undo it
  contact::Memory<double> committed;  ///< of the accepted state before this one
  contact::Memory<double> pending;    ///< to be committed when the step from this state is taken
  Vector3d position;                  ///< p_WP [m]
  Vector3d normal;                    ///< of the tile under it
  double depth = 0.;                  ///< > 0 inside the ground [m]
  int material = 0;                   ///< of the tile under it
  Vector3d force;                     ///< on the robot, world axes [N]
};

/// Layout of positions: p_WB (3), R_WB as w x y z (4) of a mobile base, then joint positions; of
/// velocities: w_WB (3), v_WB (3), then joint rates (dts/configuration.h).
class DtsRobot final : public integrators::System {
 public:
  /// `ground` may be null: no contact. All that is referred to outlives the robot.
  DtsRobot(const Experiment& experiment, int index, const contact::Terrain* ground,
           const WorldInputs& inputs);

  /// Advances the robot by `dt` [s] from `time` [s]. On failure nothing has changed.
  StepStatus step(integrators::Stepper& stepper, double time, double dt);

  /// Takes the last successful step back.
  void undo();

  /// Kinematics and contact at the present state, with the committed memory: what a step starts
  /// from and what is published.
  void refresh();
  /// Accelerations at the refreshed state, left in `workspace()`.
  void accelerate();
  /// Writes the published values of this robot's bodies and joints.
  void publish(std::span<BodyState> bodies, std::span<JointState> joints) const;

  const dts::Model<double>& model() const { return model_; }
  const dts::State<double>& state() const { return state_; }
  const std::vector<ContactPoint>& contact_points() const { return points_; }
  /// Whether a boundary point has left the terrain, whose edge tile then goes on, and what to tell
  /// the user.
  const std::string& notice() const { return notice_; }
  dts::Workspace<double>& workspace() { return workspace_; }
  const Vector3d& gravity() const { return experiment_->gravity; }

  // integrators::System
  std::size_t position_size() const override;
  std::size_t velocity_size() const override;
  integrators::Status accelerations(integrators::Stage stage, double time,
                                    std::span<const double> q, std::span<const double> v,
                                    std::span<double> a) override;
  void retract(std::span<const double> q0, std::span<const double> u,
               std::span<double> q) const override;
  void tangent_rate(std::span<const double> u, std::span<const double> v,
                    std::span<double> du) const override;

 private:
  void read_positions(std::span<const double> q);
  void write_positions(std::span<double> q) const;
  void settle_at(std::span<const double> q, std::span<const double> v);
  void evaluate_forces(bool trial);
  void apply_external_forces();
  void apply_contact_forces(bool trial);
  void take_inputs();
  void set_joint_torques();

  const Experiment* experiment_;
  int index_;
  const contact::Terrain* ground_;
  const WorldInputs* inputs_;
  std::size_t first_joint_;  ///< where the robot's joints begin in WorldInputs::joint_torques
  bool has_forces_ = false;  ///< one of the experiment's forces acts on this robot
  contact::ForceLaw law_;
  dts::Model<double> model_;
  dts::State<double> state_;
  dts::Workspace<double> workspace_;
  std::vector<ContactPoint> points_;
  std::string notice_;
  std::vector<dts::JointProperties<double>> joints_;
  std::vector<double> joint_torques_;
  std::vector<double> q_, v_, a_, q_before_, v_before_;
};

}  // namespace hookpoint::simulation
