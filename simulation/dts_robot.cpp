#include "simulation/dts_robot.h"

#include <algorithm>

#include "dts/configuration.h"
#include "dts/external_forces.h"
#include "dts/forward_dynamics.h"
#include "integrators/rotation_rate.h"

namespace hookpoint::simulation {
namespace {

dts::MassProperties<double> mass_properties(const MassSpec& mass) {
  return {mass.mass, mass.center_of_mass, mass.inertia};
}

dts::LinkDescription describe_link(const LinkSpec& link) {
  const auto type =
      link.joint == JointKind::revolute ? dts::JointType::revolute : dts::JointType::prismatic;
  return {link.a, link.alpha, link.d, link.theta, type, mass_properties(link.body.mass)};
}

dts::JointProperties<double> joint_properties(const LinkSpec& link) {
  dts::JointProperties<double> joint;
  joint.damping = link.damping;
  joint.friction = link.friction;
  joint.stiffness = link.stiffness;
  joint.rest_position = link.rest_angle;
  if (link.lower_limit) joint.lower_limit = *link.lower_limit;
  if (link.upper_limit) joint.upper_limit = *link.upper_limit;
  return joint;
}

/// Calls `action(link)` for each link of the robot, chain by chain.
template <class Action>
void for_each_link(const RobotSpec& robot, const Action& action) {
  for (const ChainSpec& chain : robot.chains) {
    for (const LinkSpec& link : chain.links) action(link);
  }
}

/// Of the two quaternions of one rotation the one nearer to `last`, so that a record has no jumps.
Quaterniond continued(const Quaterniond& q, const Quaterniond& last) {
  const double cosine = q.w * last.w + q.x * last.x + q.y * last.y + q.z * last.z;
  return cosine < 0. ? Quaterniond{-q.w, -q.x, -q.y, -q.z} : q;
}

std::vector<ContactPoint> boundary_points(const RobotSpec& robot) {
  std::vector<ContactPoint> points;
  std::size_t body = 0;
  const auto add = [&](const BodySpec& spec) {
    for (const Vector3d& p_BP : spec.boundary_points) {
      ContactPoint& point = points.emplace_back();
      point.body = body;
      point.p_BP = p_BP;
    }
    ++body;
  };
  // A fixed base cannot be moved by the ground.
  if (robot.mobile) {
    add(robot.base);
  } else {
    ++body;
  }
  for_each_link(robot, [&](const LinkSpec& link) { add(link.body); });
  return points;
}

std::size_t joints_before(const Experiment& experiment, int robot) {
  std::size_t joints = 0;
  for (int i = 0; i < robot; ++i)
    for_each_link(experiment.robots[i], [&](const LinkSpec&) { ++joints; });
  return joints;
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
      first_joint_(joints_before(experiment, index)),
      law_(contact::find_force_law(experiment.contact).value_or(contact::Hookpoint{})),
      model_(describe_robot(experiment.robots[index])),
      state_(initial_state(experiment.robots[index])),
      workspace_(model_),
      points_(ground ? boundary_points(experiment.robots[index]) : std::vector<ContactPoint>{}) {
  for_each_link(experiment.robots[index],
                [&](const LinkSpec& link) { joints_.push_back(joint_properties(link)); });
  for (const ForceSpec& force : experiment.forces) has_forces_ |= force.robot == index_;
  joint_torques_.resize(joints_.size());
  for (std::vector<double>* positions : {&q_, &q_before_}) positions->resize(position_size());
  for (std::vector<double>* velocities : {&v_, &v_before_, &a_})
    velocities->resize(velocity_size());
  refresh();
  accelerate();
}

void DtsRobot::apply_external_forces() {
  dts::clear_external_forces(workspace_);
  for (std::size_t i = 0; i < experiment_->forces.size(); ++i) {
    const ForceSpec& force = experiment_->forces[i];
    if (force.robot != index_) continue;
    const ForceInput& input = inputs_->forces[i];
    const dts::BodyMotion<double>& body = workspace_.bodies[force.body];
    dts::add_external_force(workspace_, force.body, input.force,
                            body.p_WB + body.R_WB * input.point);
    dts::add_external_torque(workspace_, force.body, input.torque);
  }
}

// The state was refreshed before its inputs were known; contact does not depend on them.
void DtsRobot::take_inputs() {
  if (!has_forces_) return;
  apply_external_forces();
  for (const ContactPoint& point : points_) {
    if (point.depth > 0.)
      dts::add_external_force(workspace_, point.body, point.force, point.position);
  }
}

// A trial state is evaluated with the memory that the step's start committed, and leaves no trace
// but its forces.
void DtsRobot::apply_contact_forces(bool trial) {
  const double dt = experiment_->deltat;
  std::visit(
      [&](const auto& law) {
        for (ContactPoint& point : points_) {
          const dts::BodyMotion<double>& body = workspace_.bodies[point.body];
          const Vector3d arm = body.R_WB * point.p_BP;
          const Vector3d position = body.p_WB + arm;
          const contact::TilePoint tile = ground_->query(position);
          const contact::PointKinematics<double> kinematics{
              position, body.v_WB + cross(body.w_WB, arm), tile.normal, tile.depth};
          const auto reaction = law.evaluate(kinematics, point.committed,
                                             experiment_->materials[tile.material].constants, dt);
          if (kinematics.depth > 0.)
            dts::add_external_force(workspace_, point.body, reaction.force, position);
          if (trial) continue;
          if (tile.outside && notice_.empty())
            notice_ = experiment_->robots[index_].name + ": " + ground_->outside_message(position);
          point.pending = reaction.next;
          point.position = position;
          point.normal = tile.normal;
          point.depth = tile.depth;
          point.material = tile.material;
          point.force = reaction.force;
        }
      },
      law_);
}

void DtsRobot::set_joint_torques() {
  for (std::size_t i = 0; i < joints_.size(); ++i) {
    joint_torques_[i] =
        inputs_->joint_torques[first_joint_ + i] +
        dts::passive_joint_torque(joints_[i], state_.joint_positions[i], state_.joint_rates[i]);
  }
}

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
}

integrators::Status DtsRobot::accelerations(integrators::Stage stage, double /*time*/,
                                            std::span<const double> q, std::span<const double> v,
                                            std::span<double> a) {
  if (stage == integrators::Stage::trial) {
    read_positions(q);
    dts::set_velocity<double>(model_, v, state_);
    evaluate_forces(true);
  }
  accelerate();
  std::copy(a_.begin(), a_.end(), a.begin());
  return integrators::all_finite(a) ? integrators::Status::ok : integrators::Status::not_finite;
}

StepStatus DtsRobot::step(integrators::Stepper& stepper, double time, double dt) {
  take_inputs();
  write_positions(q_);
  dts::get_velocity<double>(model_, state_, v_);
  q_before_ = q_;
  v_before_ = v_;
  for (ContactPoint& point : points_) {
    point.before = point.committed;
    point.committed = point.pending;
  }
  if (stepper.step(*this, time, dt, q_, v_) != integrators::Status::ok) {
    undo();
    return {StepStatus::Kind::not_finite, time, experiment_->robots[index_].name + ".base",
            "its accelerations are no longer finite: make the step smaller or the ground softer"};
  }
  settle_at(q_, v_);
  return {};
}

void DtsRobot::undo() {
  for (ContactPoint& point : points_) point.committed = point.before;
  settle_at(q_before_, v_before_);
}

void DtsRobot::settle_at(std::span<const double> q, std::span<const double> v) {
  read_positions(q);
  dts::set_velocity<double>(model_, v, state_);
  refresh();
}

void DtsRobot::publish(std::span<BodyState> bodies, std::span<JointState> joints) const {
  for (std::size_t i = 0; i < bodies.size(); ++i) {
    const dts::BodyMotion<double>& body = workspace_.bodies[i];
    const Quaterniond R_WB = i == 0 ? state_.base_orientation
                                    : continued(quaternion_from(body.R_WB), bodies[i].orientation);
    bodies[i] = {body.p_WB, R_WB, body.v_WB, body.w_WB, {}, 0};
  }
  for (const ContactPoint& point : points_) {
    bodies[point.body].contact_force += point.force;
    if (dot(point.force, point.normal) > 0.) ++bodies[point.body].contacts;
  }
  for (std::size_t i = 0; i < joints.size(); ++i) {
    joints[i] = {state_.joint_positions[i], state_.joint_rates[i],
                 workspace_.joint_accelerations[i], joint_torques_[i]};
  }
}

std::size_t DtsRobot::position_size() const { return dts::position_count(model_); }
std::size_t DtsRobot::velocity_size() const { return dts::velocity_count(model_); }

void DtsRobot::read_positions(std::span<const double> q) {
  if (model_.mobile()) {
    state_.base_position = {q[0], q[1], q[2]};
    state_.base_orientation = {q[3], q[4], q[5], q[6]};
    q = q.subspan(7);
  }
  std::copy(q.begin(), q.end(), state_.joint_positions.begin());
}

void DtsRobot::write_positions(std::span<double> q) const {
  if (model_.mobile()) {
    const Vector3d& p = state_.base_position;
    const Quaterniond& r = state_.base_orientation;
    const double base[7] = {p.x, p.y, p.z, r.w, r.x, r.y, r.z};
    std::copy(std::begin(base), std::end(base), q.begin());
    q = q.subspan(7);
  }
  std::copy(state_.joint_positions.begin(), state_.joint_positions.end(), q.begin());
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
  if (!model_.mobile()) return;
  const Vector3d rate =
      integrators::rotation_tangent_rate(Vector3d{u[0], u[1], u[2]}, Vector3d{v[0], v[1], v[2]});
  du[0] = rate.x;
  du[1] = rate.y;
  du[2] = rate.z;
}

}  // namespace hookpoint::simulation
