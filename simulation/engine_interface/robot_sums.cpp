#include "simulation/engine_interface/robot_sums.h"

#include "simulation/engine_interface/rotors.h"
#include "simulation/experiment/robot_tree.h"

namespace hookpoint::simulation {

RobotSums robot_sums(const RobotSpec& robot, const Vector3d& gravity,
                     std::span<const BodyState> bodies, std::span<const JointState> joints) {
  RobotSums sum;
  auto body = bodies.begin();
  const auto add = [&](const MassSpec& mass, const BodyState& state) {
    const Vector3d arm = rotate(state.orientation, mass.center_of_mass);
    const Vector3d center = state.position + arm;
    const Vector3d velocity = state.velocity + cross(state.angular_velocity, arm);
    const Vector3d w = rotate(conjugate(state.orientation), state.angular_velocity);
    sum.kinetic_energy += 0.5 * (mass.mass * dot(velocity, velocity) + dot(w, mass.inertia * w));
    sum.potential_energy -= mass.mass * dot(gravity, center);
    sum.center_of_mass += mass.mass * center;
    sum.center_velocity += mass.mass * velocity;
    sum.mass += mass.mass;
  };
  if (robot.mobile) add(robot.base.mass, *body);
  ++body;
  for_each_link(robot, [&](const TreeLink& at) { add(at.link.body.mass, *body++); });
  sum.kinetic_energy += rotor_energy(robot, joints);
  if (sum.mass > 0.) {
    sum.center_of_mass = (1. / sum.mass) * sum.center_of_mass;
    sum.center_velocity = (1. / sum.mass) * sum.center_velocity;
  }
  return sum;
}

}  // namespace hookpoint::simulation
