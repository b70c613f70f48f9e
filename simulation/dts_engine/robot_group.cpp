#include "simulation/dts_engine/robot_group.h"

#include <algorithm>
#include <cassert>

#include "dts/external_forces.h"
#include "simulation/dts_engine/methods.h"

namespace hookpoint::simulation {

using integrators::Stage;
using integrators::Status;

namespace {

std::vector<ArticulatedRobot> all_robots(const Experiment& experiment, const WorldInputs& inputs) {
  std::vector<ArticulatedRobot> robots;
  robots.reserve(experiment.robots.size());
  for (std::size_t i = 0; i < experiment.robots.size(); ++i)
    robots.emplace_back(experiment, i, inputs);
  return robots;
}

std::vector<dts::Workspace<double>*> workspaces_of(std::vector<ArticulatedRobot>& robots) {
  std::vector<dts::Workspace<double>*> workspaces;
  for (ArticulatedRobot& robot : robots) workspaces.push_back(&robot.workspace());
  return workspaces;
}

}  // namespace

template <class Robots, class Visit>
void RobotGroup::for_each(Robots& robots, const Visit& visit) {
  std::size_t first_q = 0, first_v = 0;
  for (auto& robot : robots) {
    visit(robot, first_q, first_v);
    first_q += robot.position_count();
    first_v += robot.velocity_count();
  }
}

RobotGroup::RobotGroup(const Experiment& experiment, const contact::Terrain* ground,
                       const WorldInputs& inputs)
    : experiment_(experiment),
      robots_(all_robots(experiment, inputs)),
      workspaces_(workspaces_of(robots_)),
      contacts_(experiment, ground, inputs, stepper_of(experiment)),
      dt_(experiment.deltat) {
  std::size_t positions = 0;
  for (const ArticulatedRobot& robot : robots_) {
    positions += robot.position_count();
    dof_count_ += robot.velocity_count();
  }
  q_.resize(positions);
  q_before_ = q_;
  v_.resize(dof_count_ + contacts_.bristle_count());
  v_before_ = v_;
  update_kinematics();
  contacts_.begin(workspaces_);
  refresh(0.);
  accelerate();
}

std::string RobotGroup::trail() const { return robots_.front().spec().name + ".base"; }

// A step.

void RobotGroup::take_inputs() {
  const auto pushed = [](const ArticulatedRobot& robot) { return robot.has_external_forces(); };
  if (std::ranges::none_of(robots_, pushed)) return;
  apply_external_forces();
  contacts_.apply_forces_again(workspaces_);
}

void RobotGroup::begin_step(double time, double dt) {
  start_ = time;
  last_time_ = time;
  dt_ = dt;
  write_positions(q_);
  q_before_ = q_;
  write_velocities(contacts_.bristles(), v_before_);
  write_velocities(contacts_.next_bristles(), v_);
  for (ArticulatedRobot& robot : robots_) robot.joints().keep();
  contacts_.begin_impulses();
}

void RobotGroup::commit_memory() {
  for (ArticulatedRobot& robot : robots_) robot.commit_joints();
  contacts_.commit();
  contacts_.begin_step();
  for (std::size_t i = 0; i < meters_.size(); ++i) {
    meters_[i].begin_step();
    meters_[i].begin(robots_[i]);
  }
}

void RobotGroup::finish_step() {
  read(q_, v_);
  for (ArticulatedRobot& robot : robots_) robot.meet_constraints();
  refresh(dt_);
  for (std::size_t i = 0; i < meters_.size(); ++i) meters_[i].end(robots_[i]);
}

void RobotGroup::measure_work() {
  if (!meters_.empty()) return;
  for (const ArticulatedRobot& robot : robots_)
    meters_.emplace_back(robot, quadrature_of(stepper_of(experiment_)));
}

void RobotGroup::add_work(double weight) {
  for (std::size_t i = 0; i < meters_.size(); ++i)
    if (meters_[i].quadrature() == WorkMeter::Quadrature::nodes) meters_[i].add(weight, robots_[i]);
}

void RobotGroup::undo() {
  contacts_.undo();
  for (ArticulatedRobot& robot : robots_) robot.joints().undo();
  read(q_before_, v_before_);
  refresh(0.);
}

void RobotGroup::restored() {
  contacts_.take_surfaces();
  contacts_.begin_impulses();
  refresh(0.);
}

// An evaluation.

void RobotGroup::update_kinematics() {
  for (ArticulatedRobot& robot : robots_) robot.update_kinematics();
}

void RobotGroup::apply_external_forces() {
  for (ArticulatedRobot& robot : robots_) robot.apply_external_forces();
}

void RobotGroup::accelerate() {
  for (ArticulatedRobot& robot : robots_) robot.accelerate();
}

void RobotGroup::apply_contacts(Evaluation evaluation, double elapsed) {
  contacts_.apply_forces(workspaces_, evaluation, elapsed, dt_);
}

void RobotGroup::refresh(double elapsed) {
  update_kinematics();
  apply_external_forces();
  apply_contacts(Evaluation::accepted, elapsed);
}

void RobotGroup::read(std::span<const double> q, std::span<const double> v) {
  for_each(robots_, [&](ArticulatedRobot& robot, std::size_t first_q, std::size_t first_v) {
    robot.read(q.subspan(first_q, robot.position_count()),
               v.subspan(first_v, robot.velocity_count()));
  });
  contacts_.read_bristles(v.subspan(dof_count_));
}

void RobotGroup::write_positions(std::span<double> q) const {
  for_each(robots_, [&](const ArticulatedRobot& robot, std::size_t first_q, std::size_t) {
    robot.write_positions(q.subspan(first_q, robot.position_count()));
  });
}

void RobotGroup::write_velocities(std::span<const double> bristles, std::span<double> v) const {
  for_each(robots_, [&](const ArticulatedRobot& robot, std::size_t, std::size_t first_v) {
    robot.write_velocities(v.subspan(first_v, robot.velocity_count()));
  });
  std::ranges::copy(bristles, v.subspan(dof_count_).begin());
}

void RobotGroup::write_accelerations(std::span<double> a) const {
  for_each(robots_, [&](const ArticulatedRobot& robot, std::size_t, std::size_t first_v) {
    robot.write_accelerations(a.subspan(first_v, robot.velocity_count()));
  });
  std::ranges::copy(contacts_.bristle_rates(), a.subspan(dof_count_).begin());
}

// What any integrator asks.

Status RobotGroup::accelerations(Stage stage, double time, std::span<const double> q,
                                 std::span<const double> v, std::span<double> a) {
  last_time_ = time;
  if (stage == Stage::trial) {
    read(q, v);
    update_kinematics();
    apply_external_forces();
    apply_contacts(Evaluation::trial, time - start_);
  }
  accelerate();
  write_accelerations(a);
  return integrators::all_finite(a) ? Status::ok : Status::not_finite;
}

double RobotGroup::greatest_angular_speed() const {
  double fastest = 0.;
  for (const ArticulatedRobot& robot : robots_)
    fastest = std::max(fastest, robot.greatest_angular_speed());
  return fastest;
}

void RobotGroup::accelerations_with_bias_of(std::span<const double> v, std::span<double> a) {
  for_each(robots_, [&](ArticulatedRobot& robot, std::size_t, std::size_t first_v) {
    const std::size_t count = robot.velocity_count();
    robot.accelerate_with_bias_of(v.subspan(first_v, count));
    robot.write_accelerations(a.subspan(first_v, count));
  });
}

void RobotGroup::take_joints_at_end_of(double h) {
  for (ArticulatedRobot& robot : robots_) robot.take_joints_at_end_of(h);
}

void RobotGroup::retract(std::span<const double> q0, std::span<const double> u,
                         std::span<double> q) const {
  for_each(robots_, [&](const ArticulatedRobot& robot, std::size_t first_q, std::size_t first_v) {
    robot.retract(q0.subspan(first_q, robot.position_count()),
                  u.subspan(first_v, robot.velocity_count()),
                  q.subspan(first_q, robot.position_count()));
  });
}

void RobotGroup::tangent_rate(std::span<const double> u, std::span<const double> v,
                              std::span<double> du) const {
  for_each(robots_, [&](const ArticulatedRobot& robot, std::size_t, std::size_t first_v) {
    const std::size_t count = robot.velocity_count();
    robot.tangent_rate(u.subspan(first_v, count), v.subspan(first_v, count),
                       du.subspan(first_v, count));
  });
  std::ranges::fill(du.subspan(dof_count_), 0.);  // bristles move no position
}

void RobotGroup::weigh(double weight) {
  if (contacts_.adaptive()) return;
  contacts_.add_impulses(weight);
  add_work(weight);
}

// What one that chooses its own steps asks besides.

void RobotGroup::weigh_at(double weight, std::span<const double> q, std::span<const double> v) {
  read(q, v);
  update_kinematics();
  if (meters_.empty())
    for (dts::Workspace<double>* workspace : workspaces_) dts::clear_external_forces(*workspace);
  else
    apply_external_forces();
  apply_contacts(Evaluation::trial, last_time_ - start_);
  contacts_.add_impulses(weight);
  add_work(weight);
}

void RobotGroup::commit(double time, std::span<const double> q, std::span<const double> v) {
  last_time_ = time;
  read(q, v);
  refresh(time - start_);
  contacts_.commit_within_step();
  for (ArticulatedRobot& robot : robots_) robot.commit_joints();
}

void RobotGroup::cross_events(std::span<const int> directions) {
  contacts_.cross_events(directions);
}

void RobotGroup::reinitialize(std::span<double> v) {
  std::ranges::copy(contacts_.next_bristles(), v.subspan(dof_count_).begin());
}

std::size_t RobotGroup::event_count() const {
  std::size_t count = contacts_.event_count();
  for (const ArticulatedRobot& robot : robots_) count += robot.joints().event_count();
  return count;
}

void RobotGroup::event_values(double time, std::span<const double> q, std::span<const double> v,
                              std::span<double> values) {
  read(q, v);
  update_kinematics();
  contacts_.event_values(workspaces_, time - start_, values.first(contacts_.event_count()));
  values = values.subspan(contacts_.event_count());
  for (const ArticulatedRobot& robot : robots_) {
    const std::size_t count = robot.joints().event_count();
    robot.joints().event_values(robot.state().joint_positions, robot.state().joint_rates,
                                values.first(count));
    values = values.subspan(count);
  }
}

Status RobotGroup::split_accelerations(double time, std::span<const double> q,
                                       std::span<const double> v, std::span<double> a_free,
                                       std::span<double> a_contact) {
  last_time_ = time;
  read(q, v);
  update_kinematics();
  apply_external_forces();
  contacts_.apply_nothing();
  accelerate();
  write_accelerations(a_free);
  // The whole comes last: it is what is published.
  apply_contacts(Evaluation::trial, time - start_);
  accelerate();
  write_accelerations(a_contact);
  for (std::size_t i = 0; i < a_free.size(); ++i) a_contact[i] -= a_free[i];
  return integrators::all_finite(a_free) && integrators::all_finite(a_contact) ? Status::ok
                                                                               : Status::not_finite;
}

bool RobotGroup::chart_exhausted(std::span<const double> u) const {
  bool exhausted = false;
  for_each(robots_, [&](const ArticulatedRobot& robot, std::size_t, std::size_t first_v) {
    exhausted |= robot.chart_exhausted(u.subspan(first_v, robot.velocity_count()));
  });
  return exhausted;
}

}  // namespace hookpoint::simulation
