#include <algorithm>

#include "simulation/engine_interface/engine.h"
#include "simulation/engine_interface/restartable.h"
#include "simulation/experiment/robot_tree.h"

namespace hookpoint::simulation {

WorldInputs initial_inputs(const Experiment& experiment) {
  WorldInputs inputs;
  for (const RobotSpec& robot : experiment.robots) {
    inputs.first_joints.push_back(inputs.joint_torques.size());
    for_each_link(robot,
                  [&](const TreeLink& at) { inputs.joint_torques.push_back(at.link.torque); });
  }
  inputs.forces_of.resize(experiment.robots.size());
  for (const ForceSpec& force : experiment.forces) {
    inputs.forces_of[static_cast<std::size_t>(force.robot)].push_back(inputs.forces.size());
    const bool waits = force.window.has_value();
    inputs.forces.push_back(
        {force.point, waits ? Vector3d{} : force.force, waits ? Vector3d{} : force.torque});
  }
  inputs.gravity = experiment.gravity;
  if (experiment.terrain) {
    inputs.ground.belt_velocity = experiment.terrain->velocity;
    inputs.ground.velocity = experiment.terrain->frame_velocity;
    inputs.ground.angular_velocity = experiment.terrain->frame_angular_velocity;
  }
  for (const ObstacleSpec& obstacle : experiment.obstacles)
    inputs.obstacles.push_back({obstacle.location,
                                obstacle.orientation,
                                obstacle.velocity,
                                obstacle.angular_velocity,
                                {}});
  return inputs;
}

void restart_inputs(const Experiment& start, WorldInputs& inputs) {
  const WorldInputs initial = initial_inputs(start);
  std::ranges::copy(initial.joint_torques, inputs.joint_torques.begin());
  std::ranges::copy(initial.forces, inputs.forces.begin());
  inputs.pull = initial.pull;
  inputs.gravity = initial.gravity;
  inputs.ground = initial.ground;
  std::ranges::copy(initial.obstacles, inputs.obstacles.begin());
}

}  // namespace hookpoint::simulation
