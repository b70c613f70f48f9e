#include "simulation/dts_engine/robot_system.h"

#include <algorithm>
#include <cassert>

#include "dts/external_forces.h"
#include "integrators/stepper.h"
#include "simulation/dts_engine/methods.h"

namespace hookpoint::simulation {

using integrators::Stage;
using integrators::Status;

RobotSystem::RobotSystem(const Experiment& experiment, std::size_t index,
                         const contact::Terrain* ground, const WorldInputs& inputs)
    : robot_(experiment, index, inputs),
      contacts_(experiment, index, robot_.model().body_count(), ground, stepper_of(experiment)),
      dt_(experiment.deltat),
      q_(position_size()),
      v_(velocity_size()),
      q_before_(q_),
      v_before_(v_) {
  refresh();
  contacts_.begin_culling();
  accelerate();
}

void RobotSystem::take_inputs() {
  if (!robot_.has_external_forces()) return;
  robot_.apply_external_forces();
  contacts_.apply_forces_again(workspace());
}

void RobotSystem::begin_step(double /*time*/, double dt) {
  dt_ = dt;
  robot_.write_positions(q_);
  q_before_ = q_;
  write_velocities(contacts_.bristles(), v_before_);
  write_velocities(contacts_.next_bristles(), v_);
  robot_.joints().keep();
  contacts_.begin_impulses();
}

void RobotSystem::commit_memory() {
  robot_.commit_joints();
  contacts_.commit();
  if (!meter_) return;
  meter_->begin_step();
  meter_->begin(robot_);
}

void RobotSystem::finish_step() {
  read(q_, v_);
  robot_.meet_constraints();
  refresh();
  if (meter_) meter_->end(robot_);
}

void RobotSystem::measure_work() {
  if (!meter_) meter_.emplace(robot_, quadrature_of(stepper_of(robot_.experiment())));
}

void RobotSystem::undo() {
  contacts_.undo();
  robot_.joints().undo();
  settle_at(q_before_, v_before_);
}

void RobotSystem::refresh() { evaluate_forces(Evaluation::accepted); }

void RobotSystem::evaluate_forces(Evaluation evaluation) {
  // X_WB and v_WB of every body, base to tips: first pass of the recursion (3.2, Fig. 3).
  robot_.update_kinematics();

  // Pushes and other forces from outside, at their points.
  robot_.apply_external_forces();

  // f_i = law(x_i, x_i', h_i) at each boundary point (3.3).
  contacts_.apply_forces(workspace(), evaluation, dt_);
}

void RobotSystem::settle_at(std::span<const double> q, std::span<const double> v) {
  read(q, v);
  refresh();
}

void RobotSystem::restored() {
  contacts_.forget_culling();
  contacts_.begin_impulses();  // they are of the next step again
  refresh();
}

void RobotSystem::read(std::span<const double> q, std::span<const double> v) {
  robot_.read(q, v);
  contacts_.read_bristles(v.subspan(dof_count()));
}

void RobotSystem::write_velocities(std::span<const double> bristles, std::span<double> v) const {
  robot_.write_velocities(v);
  std::ranges::copy(bristles, v.subspan(dof_count()).begin());
}

void RobotSystem::write_accelerations(std::span<double> a) const {
  robot_.write_accelerations(a);
  std::ranges::copy(contacts_.bristle_rates(), a.subspan(dof_count()).begin());
}

// What any integrator asks.

Status RobotSystem::accelerations(Stage stage, double /*time*/, std::span<const double> q,
                                  std::span<const double> v, std::span<double> a) {
  if (stage == Stage::trial) {
    read(q, v);
    evaluate_forces(Evaluation::trial);
  } else {
    assert(robot_.is_at(q, v));  // refreshed when the state was accepted
  }
  robot_.accelerate();
  write_accelerations(a);
  return integrators::all_finite(a) ? Status::ok : Status::not_finite;
}

void RobotSystem::accelerations_with_bias_of(std::span<const double> v, std::span<double> a) {
  robot_.accelerate_with_bias_of(v);
  robot_.write_accelerations(a);
}

void RobotSystem::tangent_rate(std::span<const double> u, std::span<const double> v,
                               std::span<double> du) const {
  robot_.tangent_rate(u, v, du);
  std::ranges::fill(du.subspan(dof_count()), 0.);  // bristles move no position
}

void RobotSystem::weigh(double weight) {
  if (contacts_.adaptive()) return;
  if (!contacts_.empty()) contacts_.add_impulses(weight);
  if (meter_ && meter_->quadrature() == WorkMeter::Quadrature::nodes) meter_->add(weight, robot_);
}

// What one that chooses its own steps asks besides.

// Kinematics and contact alone, and where work is measured the other forces: the motion is the
// integrator's.
void RobotSystem::weigh_at(double weight, std::span<const double> q, std::span<const double> v) {
  read(q, v);
  robot_.update_kinematics();
  if (meter_)
    robot_.apply_external_forces();
  else
    dts::clear_external_forces(workspace());
  contacts_.apply_forces(workspace(), Evaluation::trial, dt_);
  contacts_.add_impulses(weight);
  if (meter_) meter_->add(weight, robot_);
}

void RobotSystem::commit(double /*time*/, std::span<const double> q, std::span<const double> v) {
  if (contacts_.empty() && !robot_.joints().remembers()) return;
  settle_at(q, v);
  contacts_.commit_within_step();
  robot_.commit_joints();
}

void RobotSystem::cross_events(std::span<const int> directions) {
  contacts_.cross_events(directions);
}

// What the law let go of when the event's state was committed.
void RobotSystem::reinitialize(std::span<double> v) {
  std::ranges::copy(contacts_.next_bristles(), v.subspan(dof_count()).begin());
}

std::size_t RobotSystem::event_count() const {
  return contacts_.event_count() + robot_.joints().event_count();
}

void RobotSystem::event_values(double /*time*/, std::span<const double> q,
                               std::span<const double> v, std::span<double> values) {
  read(q, v);
  robot_.update_kinematics();
  contacts_.event_values(workspace(), values.first(contacts_.event_count()));
  robot_.joints().event_values(state().joint_positions, state().joint_rates,
                               values.subspan(contacts_.event_count()));
}

Status RobotSystem::split_accelerations(double /*time*/, std::span<const double> q,
                                        std::span<const double> v, std::span<double> a_free,
                                        std::span<double> a_contact) {
  read(q, v);
  robot_.update_kinematics();
  robot_.apply_external_forces();
  contacts_.apply_nothing();
  robot_.accelerate();
  write_accelerations(a_free);
  // The whole comes last: it is what is published.
  contacts_.apply_forces(workspace(), Evaluation::trial, dt_);
  robot_.accelerate();
  write_accelerations(a_contact);
  for (std::size_t i = 0; i < a_free.size(); ++i) a_contact[i] -= a_free[i];
  return integrators::all_finite(a_free) && integrators::all_finite(a_contact) ? Status::ok
                                                                               : Status::not_finite;
}

}  // namespace hookpoint::simulation
