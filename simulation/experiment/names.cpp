#include "simulation/experiment/names.h"

#include "simulation/experiment/robot_tree.h"

namespace hookpoint::simulation {

std::vector<std::string> body_names(const RobotSpec& robot) {
  std::vector<std::string> names{robot.base.name};
  for_each_link(
      robot, [&](const TreeLink& at) { names.push_back(at.chain.name + "." + at.link.body.name); });
  return names;
}

std::vector<std::string> body_trails(const Experiment& experiment) {
  std::vector<std::string> trails;
  for (const RobotSpec& robot : experiment.robots) {
    for (const std::string& name : body_names(robot)) trails.push_back(robot.name + "." + name);
  }
  return trails;
}

}  // namespace hookpoint::simulation
