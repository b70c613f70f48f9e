#include "simulation/engine_interface/published_work.h"

#include "simulation/experiment/robot_tree.h"

namespace hookpoint::simulation {
namespace {

Vector3d velocity_at(const BodyState& body, const Vector3d& point) {
  return body.velocity + cross(body.angular_velocity, rotate(body.orientation, point));
}

/// Twice the power of a force at the mean of two motions of its body.
double twice_power(const ForceInput& force, const BodyState& before, const BodyState& now) {
  return dot(force.force, velocity_at(before, force.point) + velocity_at(now, force.point)) +
         dot(force.torque, before.angular_velocity + now.angular_velocity);
}

}  // namespace

PublishedWork::PublishedWork(const Experiment& experiment, std::size_t index)
    : experiment_(experiment),
      index_(index),
      body_count_(body_count(experiment.robots[index])),
      joint_count_(joint_count(experiment.robots[index])) {
  for (std::size_t i = 0; i < index; ++i) {
    first_body_ += body_count(experiment.robots[i]);
    first_joint_ += joint_count(experiment.robots[i]);
  }
}

void PublishedWork::begin(const WorldState& state, const WorldInputs* inputs) {
  time_ = state.time;
  power_ = power_of_ground(state);
  bodies_ = state.bodies;
  joints_ = state.joints;
  forces_.clear();
  pull_ = {};
  if (inputs == nullptr) return;
  forces_ = inputs->forces;
  pull_ = inputs->pull;
}

WorkParts PublishedWork::over_step(const WorldState& state) const {
  const double h = state.time - time_;
  return {of_ground(state, h), of_joints(state, h), of_forces(state, h)};
}

double PublishedWork::power_of_ground(const WorldState& state) const {
  if (state.ground_force_time != GroundForceTime::now) return 0.;
  double power = 0.;
  for (const GroundForce& force : state.ground_forces)
    if (is_own(force))
      power += dot(force.force, velocity_at(state.bodies[force.body], force.point));
  return power;
}

double PublishedWork::of_ground(const WorldState& state, double h) const {
  if (state.ground_force_time == GroundForceTime::now)
    return 0.5 * h * (power_ + power_of_ground(state));
  double work = 0.;
  for (const GroundForce& force : state.ground_forces)
    if (is_own(force))
      work += 0.5 * h *
              dot(force.force, velocity_at(bodies_[force.body], force.point) +
                                   velocity_at(state.bodies[force.body], force.point));
  return work;
}

// A torque is held over the step that led to the state it is published with.
double PublishedWork::of_joints(const WorldState& state, double h) const {
  double work = 0.;
  for (std::size_t i = first_joint_; i < first_joint_ + joint_count_; ++i)
    work += 0.5 * h * state.joints[i].torque * (joints_[i].rate + state.joints[i].rate);
  return work;
}

double PublishedWork::of_forces(const WorldState& state, double h) const {
  double work = 0.;
  for (std::size_t i = 0; i < forces_.size(); ++i) {
    const ForceSpec& spec = experiment_.forces[i];
    if (static_cast<std::size_t>(spec.robot) != index_) continue;
    const std::size_t body = first_body_ + static_cast<std::size_t>(spec.body);
    work += 0.5 * h * twice_power(forces_[i], bodies_[body], state.bodies[body]);
  }
  if (pull_.robot == static_cast<int>(index_))
    work += 0.5 * h * twice_power(pull_.force, bodies_[pull_.index], state.bodies[pull_.index]);
  return work;
}

}  // namespace hookpoint::simulation
