// A robot's motion under joint torques and external forces: its state and the recursion that gives
// its accelerations (Reichler & Delcomyn 2000, section 3.2, Fig. 3). It knows no ground.
#pragma once

#include <cstddef>
#include <span>
#include <vector>

#include "dts/model.h"
#include "dts/state.h"
#include "dts/workspace.h"
#include "simulation/dts_engine/constraint_set.h"
#include "simulation/dts_engine/joint_set.h"
#include "simulation/engine_interface/engine.h"
#include "simulation/experiment/speed_limits.h"

namespace hookpoint::simulation {

/// Layout of positions q: p_WB (3), R_WB as w x y z (4) of a mobile base, then joint positions; of
/// velocities v: w_WB (3), v_WB (3), then joint rates (dts/configuration.h).
class ArticulatedRobot {
 public:
  /// Robot `index` of the experiment at its initial state. All that is referred to outlives it.
  ArticulatedRobot(const Experiment& experiment, std::size_t index, const WorldInputs& inputs);

  /// Numbers of q and of v.
  std::size_t position_count() const;
  std::size_t velocity_count() const;
  /// The present state as q and v, and the other way.
  void write_positions(std::span<double> q) const;
  void write_velocities(std::span<double> v) const;
  void read(std::span<const double> q, std::span<const double> v);
  /// Whether (q, v) is the present state, to the bit.
  bool is_at(std::span<const double> q, std::span<const double> v) const;

  /// Takes back what a step has let loops come apart: the nearest state in which they are closed. Of a
  /// robot without loops nothing.
  void meet_constraints();

  /// q = q0 (+) u and du = dexp_u^-1 v (integrators/system.h).
  void retract(std::span<const double> q0, std::span<const double> u, std::span<double> q) const;
  void tangent_rate(std::span<const double> u, std::span<const double> v,
                    std::span<double> du) const;
  /// Whether the rotation vector of u is so long that tangent_rate, singular at 2 pi, should start
  /// from a new origin.
  bool chart_exhausted(std::span<const double> u) const;
  /// Coordinates fall into groups of at most so many that do not feel each other: the chains of a
  /// base that cannot move, each with what hangs on it.
  std::size_t jacobian_block() const;

  // One evaluation of the dynamics, in this order; results stay in workspace().

  /// X_WB and v_WB of every body at the present state. O(links).
  void update_kinematics();
  /// No external force but those of the experiment's Forces, as the inputs have them now.
  void apply_external_forces();
  /// v' from M v' + c = tau + J^T f of the forces applied so far, joint torques as the inputs have
  /// them now but for what drives hold back at their velocity_limit. O(links (1 + limits met)).
  void accelerate();
  /// Greatest angular velocity of a body at the kinematics in the workspace [rad/s]. O(links).
  double greatest_angular_speed() const;
  /// v' again, from the forces and joint torques of the accelerate() before and the bias forces of
  /// the velocity `v`, which the robot has from now on: M v' + c(q, v) = tau + J^T f. O(links).
  void accelerate_with_bias_of(std::span<const double> v);
  /// From now on accelerate() has what joints exert by themselves as it is at the end of a step of
  /// `h` [s] (integrators/system.h); 0: as it is now.
  void take_joints_at_end_of(double h) { joint_step_ = h; }
  /// The joints' torques at the present state: drives as the inputs have them now, and what joints exert
  /// by themselves, less what drives held back in the last accelerate() [N m, N].
  void find_torques(std::span<double> torques) const;
  /// What drives held back in the last accelerate() [N m, N].
  std::span<const double> held_back_torques() const { return speed_limits_.held_back(); }
  /// Torques of the drives, as the inputs have them now [N m, N].
  std::span<const double> drives() const {
    return std::span(inputs_->joint_torques).subspan(first_joint_, joint_torques_.size());
  }
  /// As the inputs have it now [m/s^2].
  const Vector3d& gravity() const { return inputs_->gravity; }
  /// v' as accelerate() found it, in the layout of v.
  void write_accelerations(std::span<double> a) const;

  /// The present state is accepted: dry friction of the joints is hooked again.
  void commit_joints() { joints_.commit(state_.joint_positions, state_.joint_rates); }

  const Experiment& experiment() const { return *experiment_; }
  const RobotSpec& spec() const { return experiment_->robots[index_]; }
  std::size_t index() const { return index_; }
  const dts::Model<double>& model() const { return model_; }
  const dts::State<double>& state() const { return state_; }
  dts::Workspace<double>& workspace() { return workspace_; }
  const dts::Workspace<double>& workspace() const { return workspace_; }
  JointSet& joints() { return joints_; }
  const JointSet& joints() const { return joints_; }
  ConstraintSet& constraints() { return constraints_; }
  const ConstraintSet& constraints() const { return constraints_; }
  /// tau of the last accelerate(): drives and what joints exert by themselves, of an integrator that is
  /// implicit in them at the end of its step [N m, N].
  const std::vector<double>& joint_torques() const { return joint_torques_; }
  /// Indices of the experiment's Forces that act on it.
  std::span<const std::size_t> forces() const { return forces_; }
  /// Whether forces of the inputs act on the robot, or acted when they were applied last.
  bool has_external_forces() const { return !forces_.empty() || pulled() || was_pulled_; }

  template <class Self, class Archive>
  static void exchange(Self& self, Archive& archive) {
    archive("base_position", self.state_.base_position);
    archive("base_orientation", self.state_.base_orientation);
    archive("base_velocity", self.state_.base_velocity);
    archive("base_angular_velocity", self.state_.base_angular_velocity);
    archive("joint_position", self.state_.joint_positions);
    archive("joint_rate", self.state_.joint_rates);
    JointSet::exchange(self.joints_, archive);
  }

 private:
  /// v' from applied_torques_ under the forces in the workspace.
  void solve(ConstraintSet::Closing closing);
  /// The same, less what drives hold back at their velocity_limit.
  void solve_within_limits();
  bool pulled() const { return inputs_->pull.robot == static_cast<int>(index_); }

  const Experiment* experiment_;
  std::size_t index_;
  const WorldInputs* inputs_;
  std::size_t first_joint_;  ///< where the robot's joints begin in WorldInputs::joint_torques
  std::span<const std::size_t> forces_;
  bool was_pulled_ = false;  ///< when external forces were applied last
  dts::Model<double> model_;
  dts::State<double> state_;
  dts::Workspace<double> workspace_;
  JointSet joints_;
  SpeedLimits speed_limits_;
  std::vector<double> drive_torques_, whole_torques_;  ///< before drives hold back [N m, N]
  /// Of drives and what joints exert by themselves, before constraint forces and what an implicit
  /// integrator takes at the end of its step [N m, N].
  std::vector<double> applied_torques_;
  std::vector<double> joint_torques_;
  // Of an integrator that is implicit in the joints.
  double joint_step_ = 0.;              ///< [s]; 0: torques are those of the present state
  dts::Model<double> model_of_step_;    ///< with what joints add to their inertias over a step
  std::vector<double> joint_inertias_;  ///< of model_ [kg m^2, kg]
  std::vector<double> added_inertias_;  ///< by their springs and dampers [kg m^2, kg]
  ConstraintSet constraints_;
  std::vector<dts::Wrench<double>> open_external_;  ///< what acts beside the loops
};

}  // namespace hookpoint::simulation
