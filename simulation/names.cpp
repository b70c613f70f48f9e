#include "simulation/names.h"

namespace hookpoint::simulation {

std::vector<std::string> body_trails(const Experiment& experiment) {
  std::vector<std::string> trails;
  for (const RobotSpec& robot : experiment.robots) {
    trails.push_back(robot.name + "." + robot.base.name);
    for (const ChainSpec& chain : robot.chains) {
      for (const LinkSpec& link : chain.links) {
        trails.push_back(robot.name + "." + chain.name + "." + link.body.name);
      }
    }
  }
  return trails;
}

}  // namespace hookpoint::simulation
