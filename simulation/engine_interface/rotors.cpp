#include "simulation/engine_interface/rotors.h"

#include "simulation/experiment/robot_tree.h"

namespace hookpoint::simulation {

double rotor_energy(const RobotSpec& robot, std::span<const JointState> joints) {
  double energy = 0.;
  for_each_link(robot, [&](const TreeLink& at) {
    const double rate = joints[at.joint()].rate;
    energy += 0.5 * at.link.rotor_inertia * rate * rate;
  });
  return energy;
}

}  // namespace hookpoint::simulation
