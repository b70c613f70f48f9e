#include "simulation/experiment/robot_tree.h"

#include <algorithm>

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

std::vector<std::size_t> carriers_of(const RobotSpec& robot) {
  std::vector<std::size_t> carriers{0};
  for_each_link(robot, [&](const TreeLink& at) { carriers.push_back(at.parent); });
  return carriers;
}

bool carries_chains(const RobotSpec& robot, std::size_t body) {
  return std::ranges::count(robot.chains, body, &ChainSpec::carrier) > 0;
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
