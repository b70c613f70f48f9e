#include "simulation/dts_engine/articulated_robot.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <functional>

#include "dts/configuration.h"
#include "dts/external_forces.h"
#include "dts/forward_dynamics.h"
#include "integrators/rotation_rate.h"
#include "simulation/dts_engine/methods.h"
#include "simulation/dts_engine/robot_description.h"
#include "simulation/experiment/robot_tree.h"

namespace hookpoint::simulation {
namespace {

/// Where an integrator is implicit in the joints, each may have an inertia added to its own.
dts::RobotDescription description_of(const Experiment& experiment, std::size_t index) {
  dts::RobotDescription robot = describe_robot(experiment.robots[index]);
  if (!stepper_of(experiment).implicit_joints) return robot;
  for (dts::ChainDescription& chain : robot.chains)
    for (dts::LinkDescription& link : chain.links) link.full = true;
  return robot;
}

}  // namespace

ArticulatedRobot::ArticulatedRobot(const Experiment& experiment, std::size_t index,
                                   const WorldInputs& inputs)
    : experiment_(&experiment),
      index_(index),
      inputs_(&inputs),
      first_joint_(inputs.first_joints[index]),
      forces_(inputs.forces_of[index]),
      model_(description_of(experiment, index)),
      state_(initial_state(experiment.robots[index])),
      workspace_(model_),
      joints_(experiment.robots[index]),
      speed_limits_(experiment.robots[index], experiment.deltat),
      drive_torques_(model_.link_count()),
      whole_torques_(model_.link_count()),
      applied_torques_(model_.link_count()),
      joint_torques_(model_.link_count()),
      model_of_step_(model_),
      added_inertias_(model_.link_count()),
      constraints_(experiment, index, model_),
      open_external_(constraints_.constrains() ? model_.body_count() : 0) {
  for_each_link(spec(),
                [&](const TreeLink& at) { joint_inertias_.push_back(at.link.rotor_inertia); });
  meet_constraints();
}

std::size_t ArticulatedRobot::position_count() const { return dts::position_count(model_); }
std::size_t ArticulatedRobot::velocity_count() const { return dts::velocity_count(model_); }

void ArticulatedRobot::write_positions(std::span<double> q) const {
  if (model_.mobile()) {
    const Vector3d& p = state_.base_position;
    const Quaterniond& r = state_.base_orientation;
    const double base[7] = {p.x, p.y, p.z, r.w, r.x, r.y, r.z};
    std::copy(std::begin(base), std::end(base), q.begin());
    q = q.subspan(7);
  }
  std::copy(state_.joint_positions.begin(), state_.joint_positions.end(), q.begin());
}

void ArticulatedRobot::write_velocities(std::span<double> v) const {
  dts::get_velocity<double>(model_, state_, v);
}

void ArticulatedRobot::read(std::span<const double> q, std::span<const double> v) {
  if (model_.mobile()) {
    state_.base_position = {q[0], q[1], q[2]};
    state_.base_orientation = {q[3], q[4], q[5], q[6]};
    q = q.subspan(7);
  }
  std::copy(q.begin(), q.end(), state_.joint_positions.begin());
  dts::set_velocity<double>(model_, v.first(velocity_count()), state_);
}

bool ArticulatedRobot::is_at(std::span<const double> q, std::span<const double> v) const {
  const Vector3d& p = state_.base_position;
  const Quaterniond& r = state_.base_orientation;
  const std::array base{p.x, p.y, p.z, r.w, r.x, r.y, r.z};
  const Vector3d &w_base = state_.base_angular_velocity, &v_base = state_.base_velocity;
  const std::array base_rates{w_base.x, w_base.y, w_base.z, v_base.x, v_base.y, v_base.z};
  const std::size_t joints = state_.joint_positions.size();
  const auto at_base = [](const auto& own, std::span<const double> given) {
    return std::ranges::equal(own, given.first(own.size()));
  };
  return std::ranges::equal(state_.joint_positions, q.last(joints)) &&
         std::ranges::equal(state_.joint_rates, v.subspan(velocity_count() - joints, joints)) &&
         (!model_.mobile() || (at_base(base, q) && at_base(base_rates, v)));
}

void ArticulatedRobot::retract(std::span<const double> q0, std::span<const double> u,
                               std::span<double> q) const {
  if (model_.mobile()) {
    const Quaterniond r = integrators::rotation_retract(Quaterniond{q0[3], q0[4], q0[5], q0[6]},
                                                        Vector3d{u[0], u[1], u[2]});
    const double base[7] = {q0[0] + u[3], q0[1] + u[4], q0[2] + u[5], r.w, r.x, r.y, r.z};
    std::copy(std::begin(base), std::end(base), q.begin());
    q0 = q0.subspan(7);
    u = u.subspan(6);
    q = q.subspan(7);
  }
  std::transform(q0.begin(), q0.end(), u.begin(), q.begin(), std::plus<>());
}

void ArticulatedRobot::tangent_rate(std::span<const double> u, std::span<const double> v,
                                    std::span<double> du) const {
  std::copy(v.begin(), v.end(), du.begin());
  if (!model_.mobile()) return;
  const Vector3d rate =
      integrators::rotation_tangent_rate(Vector3d{u[0], u[1], u[2]}, Vector3d{v[0], v[1], v[2]});
  du[0] = rate.x;
  du[1] = rate.y;
  du[2] = rate.z;
}

bool ArticulatedRobot::chart_exhausted(std::span<const double> u) const {
  return model_.mobile() && norm(Vector3d{u[0], u[1], u[2]}) > 2.;
}

std::size_t ArticulatedRobot::jacobian_block() const {
  if (model_.mobile() || constraints_.joins_limbs()) return velocity_count();
  std::size_t largest = 1;
  std::vector<std::size_t> starts{0};  // of a body, the link on the base that it hangs on
  for_each_link(spec(), [&](const TreeLink& at) {
    starts.push_back(at.parent == 0 ? at.body : starts[at.parent]);
    largest = std::max(largest, at.body - starts.back() + 1);
  });
  return largest;
}

void ArticulatedRobot::update_kinematics() { dts::forward_kinematics(model_, state_, workspace_); }

void ArticulatedRobot::apply_external_forces() {
  dts::clear_external_forces(workspace_);
  for (const std::size_t i : forces_) {
    const ForceSpec& force = experiment_->forces[i];
    const ForceInput& input = inputs_->forces[i];
    const dts::BodyMotion<double>& body = workspace_.bodies[force.body];
    dts::add_external_force(workspace_, force.body, input.force,
                            body.p_WB + body.R_WB * input.point);
    dts::add_external_torque(workspace_, force.body, input.torque);
  }
  constraints_.add_spring_forces(workspace_);
  was_pulled_ = pulled();
  if (!was_pulled_) return;
  const PullInput& pull = inputs_->pull;
  const dts::BodyMotion<double>& body = workspace_.bodies[pull.body];
  dts::add_external_force(workspace_, pull.body, pull.force.force,
                          body.p_WB + body.R_WB * pull.force.point);
}

void ArticulatedRobot::find_torques(std::span<double> torques) const {
  joints_.torques(drives(), state_.joint_positions, state_.joint_rates, torques);
  const std::span<const double> held_back = held_back_torques();
  for (std::size_t i = 0; i < torques.size(); ++i) torques[i] -= held_back[i];
}

void ArticulatedRobot::solve(ConstraintSet::Closing closing) {
  const dts::Model<double>& model = joint_step_ == 0. ? model_ : model_of_step_;
  const std::span<const double> a = workspace_.joint_accelerations;
  std::ranges::copy(applied_torques_, joint_torques_.begin());
  dts::forward_dynamics<double>(model, inputs_->gravity, joint_torques_, workspace_);
  if (constraints_.constrains()) {
    // The open tree comes apart; with these forces it does not.
    constraints_.find_forces(model, state_, workspace_, closing);
    std::ranges::copy(workspace_.external, open_external_.begin());
    constraints_.add_forces(workspace_, joint_torques_);
    dts::forward_dynamics<double>(model, inputs_->gravity, joint_torques_, workspace_);
    std::ranges::copy(open_external_, workspace_.external.begin());
  }
  if (joint_step_ == 0.) return;
  for (std::size_t i = 0; i < a.size(); ++i) joint_torques_[i] -= added_inertias_[i] * a[i];
}

void ArticulatedRobot::solve_within_limits() {
  solve(ConstraintSet::Closing::at_this_moment);
  if (!speed_limits_.any()) return;
  for (std::size_t i = 0; i < drive_torques_.size(); ++i)
    drive_torques_[i] = drive_torque(joints_.properties()[i], drives()[i]);
  std::ranges::copy(applied_torques_, whole_torques_.begin());
  const auto without = [&](std::span<const double> held_back) -> std::span<const double> {
    std::ranges::transform(whole_torques_, held_back, applied_torques_.begin(), std::minus<>());
    solve(ConstraintSet::Closing::at_this_moment);
    return workspace_.joint_accelerations;
  };
  if (speed_limits_.find(drive_torques_, state_.joint_rates, workspace_.joint_accelerations,
                         without))
    without(speed_limits_.held_back());
}

void ArticulatedRobot::accelerate() {
  if (joint_step_ == 0.) {
    joints_.torques(drives(), state_.joint_positions, state_.joint_rates, applied_torques_);
    return solve_within_limits();
  }
  const double h = joint_step_;
  const std::span<const double> q = state_.joint_positions, v = state_.joint_rates,
                                a = workspace_.joint_accelerations;
  joints_.unbind_friction();
  do {
    joints_.torques_at_end_of(h, drives(), q, v, applied_torques_, added_inertias_);
    for (std::size_t i = 0; i < added_inertias_.size(); ++i)
      model_of_step_.set_rotor_inertia(i + 1, joint_inertias_[i] + added_inertias_[i]);
    solve_within_limits();
  } while (joints_.bind_friction(h, q, v, a));
}

double ArticulatedRobot::greatest_angular_speed() const {
  double squared = 0.;
  for (const dts::BodyMotion<double>& body : workspace_.bodies)
    squared = std::max(squared, dot(body.w_WB, body.w_WB));
  return std::sqrt(squared);
}

void ArticulatedRobot::accelerate_with_bias_of(std::span<const double> v) {
  dts::set_velocity<double>(model_, v.first(velocity_count()), state_);
  update_kinematics();
  if (constraints_.constrains()) constraints_.project_velocities(model_, state_, workspace_);
  solve(ConstraintSet::Closing::over_a_step);
}

void ArticulatedRobot::meet_constraints() {
  constexpr int rounds = 4;
  if (constraints_.constrains()) constraints_.close(model_, state_, workspace_, rounds);
}

void ArticulatedRobot::write_accelerations(std::span<double> a) const {
  dts::get_acceleration<double>(model_, workspace_, a);
}

}  // namespace hookpoint::simulation
