// A robot on its ground under a force law, as an integrator sees it: a second-order system with
// contact events.
#pragma once

#include <optional>
#include <span>
#include <vector>

#include "simulation/dts_engine/articulated_robot.h"
#include "simulation/dts_engine/contact_set.h"
#include "simulation/dts_engine/stepped_system.h"
#include "simulation/dts_engine/work_meter.h"

namespace hookpoint::simulation {

/// q and v are those of ArticulatedRobot; behind v stand, of a law with bristles, those of each
/// boundary point: they are integrated like velocities and move no position.
class RobotSystem final : public SteppedSystem {
 public:
  /// Robot `index` of the experiment at its initial state, refreshed and accelerated. `ground` may
  /// be null: no contact, and the law is not evaluated. All that is referred to outlives the robot.
  /// Throws ExperimentError when there is no such integrator or, above a ground, law.
  RobotSystem(const Experiment& experiment, std::size_t index, const contact::Terrain* ground,
              const WorldInputs& inputs);

  // SteppedSystem
  void take_inputs() override;
  void begin_step(double time, double dt) override;
  void commit_memory() override;
  std::span<double> positions() override { return q_; }
  std::span<double> velocities() override { return v_; }
  void finish_step() override;
  void undo() override;
  double deltat() const override { return robot_.experiment().deltat; }
  std::string trail() const override { return robot_.spec().name + ".base"; }

  /// Forces at the present state, as an accepted one: what a step starts from and what is
  /// published.
  void refresh();
  /// Goes to a state and refreshes it.
  void settle_at(std::span<const double> q, std::span<const double> v);
  /// v' from M v' + c = tau + J^T f at the refreshed state, left in `workspace()`.
  void accelerate() { robot_.accelerate(); }
  /// Whether the ground's impulses are worked out where they cost something: with an integrator
  /// that chooses its own steps.
  void enable_mean_forces(bool on) { has_means_ = on; }
  /// From the next step on `work()` is right.
  void measure_work();
  /// Of the robot's forces and joints over the last step (work_meter.h), once it is measured [J].
  double work() const { return meter_ ? meter_->work() : 0.; }
  /// Length of the last step, which the present state is the end of [s].
  double dt() const { return dt_; }

  ArticulatedRobot& robot() { return robot_; }
  const ArticulatedRobot& robot() const { return robot_; }
  ContactSet& contacts() { return contacts_; }
  const ContactSet& contacts() const { return contacts_; }
  const dts::Model<double>& model() const { return robot_.model(); }
  const dts::State<double>& state() const { return robot_.state(); }
  dts::Workspace<double>& workspace() { return robot_.workspace(); }
  const dts::Workspace<double>& workspace() const { return robot_.workspace(); }

  template <class Self, class Archive>
  static void exchange(Self& self, Archive& archive) {
    ArticulatedRobot::exchange(self.robot_, archive);
    ContactSet::exchange(self.contacts_, archive);
  }
  /// An archive has been read: refreshes what follows from it.
  void restored();

  // integrators::System
  std::size_t position_size() const override { return robot_.position_count(); }
  std::size_t velocity_size() const override { return dof_count() + contacts_.bristle_count(); }
  integrators::Status accelerations(integrators::Stage stage, double time,
                                    std::span<const double> q, std::span<const double> v,
                                    std::span<double> a) override;
  double greatest_angular_speed() const override { return robot_.greatest_angular_speed(); }
  void accelerations_with_bias_of(std::span<const double> v, std::span<double> a) override;
  void take_joints_at_end_of(double h) override { robot_.take_joints_at_end_of(h); }
  void retract(std::span<const double> q0, std::span<const double> u,
               std::span<double> q) const override {
    robot_.retract(q0, u, q);
  }
  void tangent_rate(std::span<const double> u, std::span<const double> v,
                    std::span<double> du) const override;
  void weigh(double weight) override;

  // integrators::HybridSystem
  bool has_integrals() const override { return meter_ || (has_means_ && !contacts_.empty()); }
  void weigh_at(double weight, std::span<const double> q, std::span<const double> v) override;
  void commit(double time, std::span<const double> q, std::span<const double> v) override;
  void cross_events(std::span<const int> directions) override;
  void reinitialize(std::span<double> v) override;
  /// Those of ContactSet, then those of JointSet.
  std::size_t event_count() const override;
  void event_values(double time, std::span<const double> q, std::span<const double> v,
                    std::span<double> values) override;
  integrators::Status split_accelerations(double time, std::span<const double> q,
                                          std::span<const double> v, std::span<double> a_free,
                                          std::span<double> a_contact) override;
  bool chart_exhausted(std::span<const double> u) const override {
    return robot_.chart_exhausted(u);
  }
  std::size_t dof_count() const override { return robot_.velocity_count(); }
  bool is_active_state(std::size_t i) const override {
    return contacts_.is_active_state(i - dof_count());
  }
  std::size_t jacobian_block() const override { return robot_.jacobian_block(); }

 private:
  /// Kinematics of every body at the present state and all forces on it, in the workspace. O(links
  /// + points).
  void evaluate_forces(Evaluation evaluation);
  void read(std::span<const double> q, std::span<const double> v);
  void write_velocities(std::span<const double> bristles, std::span<double> v) const;
  void write_accelerations(std::span<double> a) const;

  ArticulatedRobot robot_;
  ContactSet contacts_;
  double dt_;  ///< of the present step, or the last; before the first, of that [s]
  bool has_means_ = true;
  std::optional<WorkMeter> meter_;  ///< once it is wanted
  std::vector<double> q_, v_, q_before_, v_before_;
};

}  // namespace hookpoint::simulation
