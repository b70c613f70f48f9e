#include "simulation/engine/dts_robot.h"

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <cassert>
#include <limits>

#include "contact/bristle_step.h"
#include "dts/configuration.h"
#include "dts/external_forces.h"
#include "dts/forward_dynamics.h"
#include "integrators/adaptive.h"
#include "integrators/rotation_rate.h"
#include "simulation/joint_properties.h"

namespace hookpoint::simulation {
namespace {

dts::MassProperties<double> mass_properties(const MassSpec& mass) {
  return {mass.mass, mass.center_of_mass, mass.inertia};
}

dts::LinkDescription describe_link(const LinkSpec& link) {
  const auto type =
      link.joint == JointKind::revolute ? dts::JointType::revolute : dts::JointType::prismatic;
  return {link.a,
          link.alpha,
          link.d,
          link.theta,
          type,
          mass_properties(link.body.mass),
          link.joint_location,
          link.joint_orientation};
}

/// Calls `action(link)` for each link of the robot, chain by chain.
template <class Action>
void for_each_link(const RobotSpec& robot, const Action& action) {
  for (const ChainSpec& chain : robot.chains) {
    for (const LinkSpec& link : chain.links) action(link);
  }
}

StepStatus explain(integrators::Status status, double time, std::string body) {
  if (status == integrators::Status::too_long) {
    return {StepStatus::Kind::solver_failed, time, std::move(body),
            fmt::format("this step has taken {} evaluations and is not over: raise "
                        "relative_tolerance and absolute_tolerance, bring the constants of ground "
                        "and joints nearer to each other, make deltat smaller, or choose a "
                        "fixed-step integrator",
                        integrators::most_evaluations)};
  }
  if (status == integrators::Status::no_step) {
    return {StepStatus::Kind::solver_failed, time, std::move(body),
            "the integrator finds no step that meets its tolerances: raise relative_tolerance and "
            "absolute_tolerance, make the ground softer, or choose a fixed-step integrator"};
  }
  return {StepStatus::Kind::not_finite, time, std::move(body),
          "its accelerations are no longer finite: make the step smaller or the ground softer"};
}

bool is_adaptive(const std::string& integrator) {
  const integrators::StepperDescription* stepper = integrators::find_stepper(integrator);
  return stepper != nullptr && stepper->adaptive();
}

contact::AnyForceLaw law_of(const Experiment& experiment) {
  const auto law = contact::find_force_law(experiment.contact).value_or(contact::Hookpoint{});
  return is_adaptive(experiment.integrator) ? contact::rate_form(law) : law;
}

}  // namespace

dts::RobotDescription describe_robot(const RobotSpec& robot) {
  dts::RobotDescription description{robot.mobile, mass_properties(robot.base.mass), {}};
  for (const ChainSpec& chain : robot.chains) {
    dts::ChainDescription& added = description.chains.emplace_back();
    added.hip_position = chain.hip_distance;
    added.hip_orientation = chain.hip_orientation;
    for (const LinkSpec& link : chain.links) added.links.push_back(describe_link(link));
  }
  return description;
}

dts::State<double> initial_state(const RobotSpec& robot) {
  dts::State<double> state{robot.location, robot.orientation, {}, {}, {}, {}};
  if (robot.mobile) {
    state.base_velocity = robot.velocity;
    state.base_angular_velocity = robot.angular_velocity;
  }
  for_each_link(robot, [&](const LinkSpec& link) {
    state.joint_positions.push_back(link.angle);
    state.joint_rates.push_back(link.rate);
  });
  return state;
}

DtsRobot::DtsRobot(const Experiment& experiment, int index, const contact::Terrain* ground,
                   const WorldInputs& inputs)
    : experiment_(&experiment),
      index_(index),
      ground_(ground),
      inputs_(&inputs),
      first_joint_(inputs.first_joints[static_cast<std::size_t>(index)]),
      forces_(inputs.forces_of[static_cast<std::size_t>(index)]),
      adaptive_(is_adaptive(experiment.integrator)),
      law_(law_of(experiment)),
      bristle_states_(contact::bristle_states(law_)),
      semi_implicit_(experiment.integrator == "semi_implicit_euler"),
      law_step_(experiment.deltat),
      law_step_before_(experiment.deltat),
      model_(describe_robot(experiment.robots[index])),
      state_(initial_state(experiment.robots[index])),
      workspace_(model_),
      points_(ground ? boundary_points(experiment.robots[index]) : std::vector<ContactPoint>{}) {
  for_each_link(experiment.robots[index],
                [&](const LinkSpec& link) { joints_.push_back(joint_properties(link)); });
  for (std::size_t i = 0; i < joints_.size(); ++i)
    if (joints_[i].friction > 0.) dry_joints_.push_back({i});
  anchors_ = anchors_before_ = state_.joint_positions;
  for (std::size_t body = 0; body <= model_.body_count(); ++body) {
    const auto first = std::ranges::lower_bound(points_, body, {}, &ContactPoint::body);
    first_points_.push_back(static_cast<std::size_t>(first - points_.begin()));
  }
  joint_torques_.resize(joints_.size());
  for (std::vector<double>* bristles : {&bristles_, &next_bristles_, &bristle_rates_})
    bristles->resize(bristle_states_ * points_.size());
  for (std::vector<double>* positions : {&q_, &q_before_}) positions->resize(position_size());
  for (std::vector<double>* velocities : {&v_, &v_before_, &a_})
    velocities->resize(velocity_size());
  passed_.resize(model_.body_count());
  for (std::vector<Vector3d>* vectors : {&ground_forces_, &ground_impulses_})
    vectors->resize(model_.body_count());
  constexpr double infinity = std::numeric_limits<double>::infinity();
  boxes_.resize(model_.body_count(), {{}, {infinity, infinity, infinity}});
  refresh();  // of all points, for those who ask for the initial state
  bound_points();
  accelerate();
}

void DtsRobot::apply_external_forces() {
  dts::clear_external_forces(workspace_);
  for (const std::size_t i : forces_) {
    const ForceSpec& force = experiment_->forces[i];
    const ForceInput& input = inputs_->forces[i];
    const dts::BodyMotion<double>& body = workspace_.bodies[force.body];
    dts::add_external_force(workspace_, force.body, input.force,
                            body.p_WB + body.R_WB * input.point);
    dts::add_external_torque(workspace_, force.body, input.torque);
  }
}

// The state was refreshed before its inputs were known; contact does not depend on them.
void DtsRobot::take_inputs() {
  if (forces_.empty()) return;
  apply_external_forces();
  for (const ContactPoint& point : points_) {
    if (point.pending.attached)
      dts::add_external_force(workspace_, point.body, point.force, point.position);
  }
}

void DtsRobot::apply_contact_forces(bool trial) {
  if (points_.empty()) return;
  std::visit(
      [&](const auto& law) {
        for (std::size_t body = 0; body < passed_.size(); ++body) {
          ground_forces_[body] = {};
          if (passed_over(body, trial)) continue;
          for (std::size_t i = first_points_[body]; i < first_points_[body + 1]; ++i)
            apply_contact_force(law, i, trial);
        }
      },
      law_);
}

// A trial state is evaluated with the memory that the step's start committed, and leaves no trace
// but its forces.
template <class Law>
void DtsRobot::apply_contact_force(const Law& law, std::size_t i, bool trial) {
  // An integrator that chooses its steps gets laws that know none (contact::rate_form).
  const double dt = adaptive_ ? 0. : law_step_;
  ContactPoint& point = points_[i];
  const dts::BodyMotion<double>& body = workspace_.bodies[point.body];
  const TouchingPlace touching = touching_place(point, body, *ground_);
  const contact::TilePoint& tile = touching.tile;
  const Vector3d& position = touching.position;
  const auto& material = experiment_->materials[tile.material].constants;
  const double reach = law.reach(material);
  if (!trial) point.inside = tile.depth > -reach;
  const double depth = adaptive_ ? point.depth_on_side(tile.depth, reach) : tile.depth;
  const contact::BallFrame frame = ball_frame(point, body, tile);
  if (!trial) {
    if (tile.outside && notice_.empty())
      notice_ = experiment_->robots[index_].name + ": " + ground_->outside_message(position);
    if (point.radius > 0.) point.pending_frame = frame;
    point.position = position;
    point.normal = tile.normal;
    point.depth = tile.depth;
    point.material = tile.material;
  }
  if (!(depth > -reach)) {
    leave_alone(i, trial);
    return;
  }
  contact::PointKinematics<double> kinematics{position, touching.velocity, tile.normal, depth,
                                              bristle_at(bristles_, i)};
  const contact::Memory<double> memory = point.carried(frame);
  if (!trial) kinematics = contact::held_point(law, kinematics, memory, material, dt);
  const contact::Reaction<double> reaction =
      semi_implicit_ ? contact::reaction_with_moved_bristle(law, kinematics, memory, material, dt)
                     : law.evaluate(kinematics, memory, material, dt);
  if (reaction.next.attached) {
    dts::add_external_force(workspace_, point.body, reaction.force, position);
    ground_forces_[point.body] += reaction.force;
  }
  put_bristle(reaction.bristle_rate, i, bristle_rates_);
  if (trial) return;
  put_bristle(reaction.bristle, i, next_bristles_);
  point.pending = reaction.next;
  point.force = reaction.force;
}

// Beyond its reach the law gives and remembers nothing.
void DtsRobot::leave_alone(std::size_t i, bool trial) {
  put_bristle({}, i, bristle_rates_);
  if (trial) return;
  put_bristle({}, i, next_bristles_);
  points_[i].pending = {};
  points_[i].force = {};
}

void DtsRobot::set_joint_torques() {
  for (std::size_t i = 0; i < joints_.size(); ++i) {
    joint_torques_[i] = inputs_->joint_torques[first_joint_ + i] +
                        dts::passive_joint_torque(joints_[i], state_.joint_positions[i],
                                                  state_.joint_rates[i], anchors_[i]);
  }
}

void DtsRobot::commit_anchors() {
  for (DryJoint& dry : dry_joints_) {
    const std::size_t i = dry.joint;
    const double before = anchors_[i];
    anchors_[i] = dts::dragged_anchor(joints_[i], state_.joint_positions[i], before);
    const double stretch = state_.joint_positions[i] - anchors_[i];
    dry.slips = anchors_[i] != before && stretch * state_.joint_rates[i] > 0.;
  }
}

void DtsRobot::keep_anchors() { anchors_before_ = anchors_; }
void DtsRobot::undo_anchors() { anchors_ = anchors_before_; }

void DtsRobot::evaluate_forces(bool trial) {
  dts::forward_kinematics(model_, state_, workspace_);
  apply_external_forces();
  apply_contact_forces(trial);
}

void DtsRobot::refresh() { evaluate_forces(false); }

void DtsRobot::accelerate() {
  set_joint_torques();
  dts::forward_dynamics<double>(model_, experiment_->gravity, joint_torques_, workspace_);
  dts::get_acceleration<double>(model_, workspace_, a_);
  std::ranges::copy(bristle_rates_, a_.end() - std::ssize(bristle_rates_));
}

integrators::Status DtsRobot::accelerations(integrators::Stage stage, double /*time*/,
                                            std::span<const double> q, std::span<const double> v,
                                            std::span<double> a) {
  if (stage == integrators::Stage::trial) {
    read_state(q, v);
    evaluate_forces(true);
  } else {
    assert(is_at(q, v));  // refreshed when the state was accepted
  }
  accelerate();
  std::copy(a_.begin(), a_.end(), a.begin());
  return integrators::all_finite(a) ? integrators::Status::ok : integrators::Status::not_finite;
}

void DtsRobot::weigh(double weight) {
  if (points_.empty() || adaptive_) return;
  for (std::size_t body = 0; body < ground_forces_.size(); ++body)
    ground_impulses_[body] += weight * ground_forces_[body];
}

StepStatus DtsRobot::step(integrators::Stepper& stepper, double time, double dt) {
  take_inputs();
  write_positions(q_);
  q_before_ = q_;
  write_velocities(v_before_, bristles_);
  write_velocities(v_, next_bristles_);
  keep_anchors();
  commit_anchors();
  commit_points();
  std::ranges::fill(ground_impulses_, Vector3d{});
  law_step_before_ = law_step_;
  law_step_ = dt;
  const integrators::Status status = stepper.step(*this, time, dt, q_, v_);
  if (status != integrators::Status::ok) {
    undo();
    return explain(status, time, experiment_->robots[index_].name + ".base");
  }
  settle_at(q_, v_);
  return {};
}

void DtsRobot::undo() {
  for (ContactPoint& point : points_) {
    point.committed = point.before;
    point.committed_frame = point.before_frame;
  }
  std::ranges::fill(passed_, 0);
  undo_anchors();
  law_step_ = law_step_before_;
  settle_at(q_before_, v_before_);
}

void DtsRobot::read_state(std::span<const double> q, std::span<const double> v) {
  read_positions(q);
  dts::set_velocity<double>(model_, v.first(dts::velocity_count(model_)), state_);
  std::ranges::copy(v.last(bristles_.size()), bristles_.begin());
}

bool DtsRobot::is_at(std::span<const double> q, std::span<const double> v) const {
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
         std::ranges::equal(state_.joint_rates, v.subspan(moving_size() - joints, joints)) &&
         (!model_.mobile() || (at_base(base, q) && at_base(base_rates, v)));
}

void DtsRobot::write_velocities(std::span<double> v, std::span<const double> bristles) const {
  dts::get_velocity<double>(model_, state_, v);
  std::ranges::copy(bristles, v.last(bristles.size()).begin());
}

contact::Bristle<double> DtsRobot::bristle_at(std::span<const double> numbers,
                                              std::size_t point) const {
  if (bristle_states_ == 0) return {};
  const double* z = &numbers[bristle_states_ * point];
  return {{z[0], z[1], z[2]}, bristle_states_ > 3 ? z[3] : 0.};
}

void DtsRobot::put_bristle(const contact::Bristle<double>& bristle, std::size_t point,
                           std::span<double> numbers) const {
  if (bristle_states_ == 0) return;
  double* z = &numbers[bristle_states_ * point];
  z[0] = bristle.deflection.x;
  z[1] = bristle.deflection.y;
  z[2] = bristle.deflection.z;
  if (bristle_states_ > 3) z[3] = bristle.sliding;
}

void DtsRobot::settle_at(std::span<const double> q, std::span<const double> v) {
  read_state(q, v);
  refresh();
}

std::size_t DtsRobot::position_size() const { return dts::position_count(model_); }
std::size_t DtsRobot::velocity_size() const {
  return dts::velocity_count(model_) + bristles_.size();
}

void DtsRobot::retract(std::span<const double> q0, std::span<const double> u,
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

void DtsRobot::tangent_rate(std::span<const double> u, std::span<const double> v,
                            std::span<double> du) const {
  std::copy(v.begin(), v.end(), du.begin());
  std::ranges::fill(du.last(bristles_.size()), 0.);  // bristles move no position
  if (!model_.mobile()) return;
  const Vector3d rate =
      integrators::rotation_tangent_rate(Vector3d{u[0], u[1], u[2]}, Vector3d{v[0], v[1], v[2]});
  du[0] = rate.x;
  du[1] = rate.y;
  du[2] = rate.z;
}

}  // namespace hookpoint::simulation
