#include "simulation/robot_tree.h"

namespace hookpoint::simulation {

std::size_t joint_count(const RobotSpec& robot) {
  std::size_t count = 0;
  for (const ChainSpec& chain : robot.chains) count += chain.links.size();
  return count;
}

std::size_t body_count(const RobotSpec& robot) { return 1 + joint_count(robot); }

std::vector<const BodySpec*> bodies_of(const RobotSpec& robot) {
  std::vector<const BodySpec*> bodies;
  for_each_body(robot, [&](const BodySpec& body) { bodies.push_back(&body); });
  return bodies;
}

double robot_mass(const RobotSpec& robot) {
  double mass = 0.;
  for_each_body(robot, [&](const BodySpec& body) { mass += body.mass.mass; });
  return mass;
}

double moving_mass(const RobotSpec& robot) {
  double mass = robot.mobile ? robot.base.mass.mass : 0.;
  for_each_link(robot, [&](const TreeLink& at) { mass += at.link.body.mass.mass; });
  return mass;
}

}  // namespace hookpoint::simulation
