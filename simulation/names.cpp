#include "simulation/names.h"

#include "simulation/robot_tree.h"

namespace hookpoint::simulation {

std::vector<std::string> body_trails(const Experiment& experiment) {
  std::vector<std::string> trails;
  for (const RobotSpec& robot : experiment.robots) {
    trails.push_back(robot.name + "." + robot.base.name);
    for_each_link(robot, [&](const TreeLink& at) {
      trails.push_back(robot.name + "." + at.chain.name + "." + at.link.body.name);
    });
  }
  return trails;
}

}  // namespace hookpoint::simulation
