// The robots of an experiment together, as bodies that touch each other, under a force law: what an
// integrator moves under `touch = shapes`.
#pragma once

#include <span>
#include <vector>

#include "simulation/dts_engine/articulated_robot.h"
#include "simulation/dts_engine/shape_contacts.h"
#include "simulation/dts_engine/stepped_system.h"
#include "simulation/dts_engine/work_meter.h"

namespace hookpoint::simulation {

/// q and v are those of each ArticulatedRobot, one after the other; behind them in v stand, of a law
/// with bristles, those of the contacts' slots.
class RobotGroup final : public SteppedSystem {
 public:
  /// All robots at their initial state, refreshed and accelerated. `ground` may be null. All that is
  /// referred to outlives the group.
  RobotGroup(const Experiment& experiment, const contact::Terrain* ground,
             const WorldInputs& inputs);

  std::vector<ArticulatedRobot>& robots() { return robots_; }
  const std::vector<ArticulatedRobot>& robots() const { return robots_; }
  ShapeContacts& contacts() { return contacts_; }
  const ShapeContacts& contacts() const { return contacts_; }
  double dt() const { return dt_; }
  void enable_mean_forces(bool on) { has_means_ = on; }
  /// From the next step on `works` are right.
  void measure_work();
  /// Work of each robot's forces and joints over the last step (work_meter.h); empty until it is
  /// measured.
  std::span<const WorkMeter> works() const { return meters_; }

  template <class Self, class Archive>
  static void exchange(Self& self, Archive& archive) {
    for (auto& robot : self.robots_) ArticulatedRobot::exchange(robot, archive);
    ShapeContacts::exchange(self.contacts_, archive);
  }
  /// An archive has been read: refreshes what follows from it.
  void restored();

  // SteppedSystem
  void take_inputs() override;
  void begin_step(double time, double dt) override;
  void commit_memory() override;
  std::span<double> positions() override { return q_; }
  std::span<double> velocities() override { return v_; }
  void finish_step() override;
  void undo() override;
  double deltat() const override { return experiment_.deltat; }
  std::string trail() const override;

  // integrators::System
  std::size_t position_size() const override { return q_.size(); }
  std::size_t velocity_size() const override { return v_.size(); }
  integrators::Status accelerations(integrators::Stage stage, double time,
                                    std::span<const double> q, std::span<const double> v,
                                    std::span<double> a) override;
  double greatest_angular_speed() const override;
  void accelerations_with_bias_of(std::span<const double> v, std::span<double> a) override;
  void take_joints_at_end_of(double h) override;
  void retract(std::span<const double> q0, std::span<const double> u,
               std::span<double> q) const override;
  void tangent_rate(std::span<const double> u, std::span<const double> v,
                    std::span<double> du) const override;
  void weigh(double weight) override;

  // integrators::HybridSystem
  bool has_integrals() const override {
    return has_means_ || !meters_.empty() || contacts_.surfaces_move();
  }
  void weigh_at(double weight, std::span<const double> q, std::span<const double> v) override;
  void commit(double time, std::span<const double> q, std::span<const double> v) override;
  void cross_events(std::span<const int> directions) override;
  void reinitialize(std::span<double> v) override;
  /// Those of ShapeContacts, then those of each robot's joints.
  std::size_t event_count() const override;
  void event_values(double time, std::span<const double> q, std::span<const double> v,
                    std::span<double> values) override;
  integrators::Status split_accelerations(double time, std::span<const double> q,
                                          std::span<const double> v, std::span<double> a_free,
                                          std::span<double> a_contact) override;
  bool chart_exhausted(std::span<const double> u) const override;
  std::size_t dof_count() const override { return dof_count_; }
  bool is_active_state(std::size_t i) const override {
    return contacts_.is_active_state(i - dof_count_);
  }

 private:
  /// Calls `visit(robot, first_q, first_v)` for each.
  template <class Robots, class Visit>
  static void for_each(Robots& robots, const Visit& visit);
  void update_kinematics();
  /// Each robot's meter counts the present state for `weight` [s].
  void add_work(double weight);
  void apply_external_forces();
  void accelerate();
  void refresh(double elapsed);
  void apply_contacts(Evaluation evaluation, double elapsed);
  void read(std::span<const double> q, std::span<const double> v);
  void write_positions(std::span<double> q) const;
  void write_velocities(std::span<const double> bristles, std::span<double> v) const;
  void write_accelerations(std::span<double> a) const;

  const Experiment& experiment_;
  std::vector<ArticulatedRobot> robots_;
  std::vector<dts::Workspace<double>*> workspaces_;
  ShapeContacts contacts_;
  double start_ = 0.;  ///< of the present step [s]
  double dt_;
  double last_time_ = 0.;  ///< of the evaluation before, for integrals over a step [s]
  bool has_means_ = true;
  std::vector<WorkMeter> meters_;  ///< one a robot, once they are wanted
  std::size_t dof_count_ = 0;
  std::vector<double> q_, v_, q_before_, v_before_;
};

}  // namespace hookpoint::simulation
