#include "simulation/wiring/derived_ports.h"

#include <cmath>
#include <span>

#include "simulation/engine_interface/rotors.h"
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
      bodies_(engine.state().bodies.size()),
      joint_bias_(experiment),
      contact_forces_(engine),
      details_(engine),
      reactions_(engine) {}

void DerivedPorts::update() {
  finite_ = true;
  energies_.update();
  accelerations_.update();
  contacts_.update();
  joint_terms_.update();
}

void DerivedPorts::restart() {
  before_.clear();
  update();
}

// T = (m v_c^2 + w.I w + I_r q'^2)/2, V = -m g.c of every body that moves.
void DerivedPorts::compute_energies() {
  auto body = engine_.state().bodies.begin();
  std::span joints(engine_.state().joints);
  for (std::size_t i = 0; i < robots_.size(); ++i) {
    const RobotSpec& robot = experiment_.robots[i];
    RobotValues sum;
    const auto add = [&](const MassSpec& mass, const BodyState& state) {
      const Vector3d arm = rotate(state.orientation, mass.center_of_mass);
      const Vector3d center = state.position + arm;
      const Vector3d velocity = state.velocity + cross(state.angular_velocity, arm);
      const Vector3d w = rotate(conjugate(state.orientation), state.angular_velocity);
      sum.kinetic_energy += 0.5 * (mass.mass * dot(velocity, velocity) + dot(w, mass.inertia * w));
      sum.potential_energy -= mass.mass * dot(experiment_.gravity, center);
      sum.center_of_mass += mass.mass * center;
      sum.center_velocity += mass.mass * velocity;
      sum.mass += mass.mass;
    };
    if (robot.mobile) add(robot.base.mass, *body);
    ++body;
    for_each_link(robot, [&](const TreeLink& at) { add(at.link.body.mass, *body++); });
    sum.kinetic_energy += rotor_energy(robot, joints);
    joints = joints.subspan(joint_count(robot));
    if (sum.mass > 0.) {
      sum.center_of_mass = (1. / sum.mass) * sum.center_of_mass;
      sum.center_velocity = (1. / sum.mass) * sum.center_velocity;
    }
    finite_ = finite_ && std::isfinite(sum.kinetic_energy) && std::isfinite(sum.potential_energy) &&
              is_finite(sum.center_of_mass);
    robots_[i] = sum;
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
