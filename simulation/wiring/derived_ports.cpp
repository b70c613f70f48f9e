#include "simulation/wiring/derived_ports.h"

#include <cmath>
#include <span>

#include "simulation/experiment/robot_tree.h"

namespace hookpoint::simulation {
namespace {

bool is_finite(const Vector3d& a) {
  return std::isfinite(a.x) && std::isfinite(a.y) && std::isfinite(a.z);
}

}  // namespace

DerivedPorts::DerivedPorts(const Experiment& experiment, Engine& engine)
    : experiment_(experiment),
      engine_(engine),
      robots_(experiment.robots.size()),
      numerical_(experiment.robots.size()),
      bodies_(engine.state().bodies.size()),
      joint_bias_(experiment),
      balance_(experiment, engine),
      contact_forces_(engine),
      details_(engine),
      surface_contacts_(engine),
      reactions_(engine) {}

void DerivedPorts::update() {
  finite_ = true;
  balance_.end_step();
  energies_.update();
  numerical_energies_.update();
  accelerations_.update();
  contacts_.update();
  joint_terms_.update();
}

void DerivedPorts::restart() {
  before_.clear();
  balance_.restored();
  update();
}

void DerivedPorts::compute_energies() {
  std::span bodies(engine_.state().bodies);
  std::span joints(engine_.state().joints);
  for (std::size_t i = 0; i < robots_.size(); ++i) {
    const RobotSpec& robot = experiment_.robots[i];
    RobotSums& sum = robots_[i];
    sum = robot_sums(robot, experiment_.gravity, bodies, joints);
    bodies = bodies.subspan(body_count(robot));
    joints = joints.subspan(joint_count(robot));
    finite_ = finite_ && std::isfinite(sum.kinetic_energy) && std::isfinite(sum.potential_energy) &&
              is_finite(sum.center_of_mass);
  }
}

void DerivedPorts::compute_numerical_energies() {
  for (std::size_t i = 0; i < numerical_.size(); ++i) {
    numerical_[i] = balance_.numerical_energy(i);
    finite_ = finite_ && std::isfinite(numerical_[i]);
  }
}

void DerivedPorts::compute_accelerations() {
  const std::vector<BodyState>& now = engine_.state().bodies;
  if (before_.empty()) before_ = now;
  const double per_second = 1. / experiment_.deltat;
  for (std::size_t i = 0; i < now.size(); ++i) {
    bodies_[i].acceleration = per_second * (now[i].velocity - before_[i].velocity);
    bodies_[i].angular_acceleration =
        per_second * (now[i].angular_velocity - before_[i].angular_velocity);
    finite_ =
        finite_ && is_finite(bodies_[i].acceleration) && is_finite(bodies_[i].angular_acceleration);
    before_[i] = now[i];
  }
}

void DerivedPorts::compute_joint_bias() {
  joint_bias_.compute(engine_.state());
  for (const JointBiasValues& joint : joint_bias_.values())
    finite_ = finite_ && std::isfinite(joint.all);
}

void DerivedPorts::compute_contacts() {
  const std::vector<BodyState>& now = engine_.state().bodies;
  for (std::size_t i = 0; i < now.size(); ++i)
    bodies_[i].contacts = static_cast<double>(now[i].contacts);
}

}  // namespace hookpoint::simulation
