#include "simulation/engine_interface/moving_energy.h"

#include <algorithm>

#include "simulation/experiment/robot_tree.h"

namespace hookpoint::simulation {
namespace {

constexpr std::size_t parts_of_body = 6, parts_of_joint = 2;

}  // namespace

MovingEnergy::MovingEnergy(const Experiment& experiment, std::size_t index)
    : experiment_(experiment), index_(index) {
  for (std::size_t i = 0; i < index; ++i) {
    first_body_ += body_count(experiment.robots[i]);
    first_joint_ += joint_count(experiment.robots[i]);
  }
  const RobotSpec& robot = experiment.robots[index];
  parts_.resize(1 + parts_of_body * body_count(robot) + parts_of_joint * joint_count(robot));
}

void MovingEnergy::take(std::size_t part, double value) {
  Part& range = parts_[part];
  range.least = begun_ ? std::min(range.least, value) : value;
  range.most = begun_ ? std::max(range.most, value) : value;
}

void MovingEnergy::observe(const WorldState& state) {
  const RobotSpec& robot = experiment_.robots[index_];
  std::size_t body = first_body_, part = 1;
  double weights = 0.;
  const auto add = [&](const MassSpec& mass) {
    const BodyState& motion = state.bodies[body++];
    const Vector3d arm = rotate(motion.orientation, mass.center_of_mass);
    const Vector3d v = motion.velocity + cross(motion.angular_velocity, arm);
    const Vector3d w = rotate(conjugate(motion.orientation), motion.angular_velocity);
    const Vector3d L = mass.inertia * w;
    for (const double speed : {v.x, v.y, v.z}) take(part++, 0.5 * mass.mass * speed * speed);
    for (const double turning : {w.x * L.x, w.y * L.y, w.z * L.z}) take(part++, 0.5 * turning);
    weights -= mass.mass * dot(experiment_.gravity, motion.position + arm);
  };
  if (robot.mobile)
    add(robot.base.mass);
  else
    ++body;
  for_each_link(robot, [&](const TreeLink& at) {
    add(at.link.body.mass);
    const JointState& joint = state.joints[first_joint_ + at.joint()];
    const double stretch = joint.angle - at.link.rest_angle;
    take(part++, 0.5 * at.link.rotor_inertia * joint.rate * joint.rate);
    take(part++, 0.5 * at.link.stiffness * stretch * stretch);
  });
  take(0, weights);
  begun_ = true;
}

double MovingEnergy::value() const {
  double sum = 0.;
  for (const Part& range : parts_) sum += range.most - range.least;
  return 0.5 * sum;
}

}  // namespace hookpoint::simulation
