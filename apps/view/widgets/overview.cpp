#include "apps/view/widgets/overview.h"

#include <algorithm>

#include "simulation/experiment/robot_tree.h"

namespace hookpoint::view {

std::vector<std::string> overview_of(const simulation::Experiment& experiment) {
  constexpr std::size_t most_of_a_kind = 8;
  if (experiment.robots.empty()) return {};
  const auto mobile = std::ranges::find_if(experiment.robots, &simulation::RobotSpec::mobile);
  const simulation::RobotSpec& robot =
      mobile == experiment.robots.end() ? experiment.robots.front() : *mobile;
  const std::string prefix = experiment.world + "." + robot.name + ".";
  std::vector<std::string> trails;
  for (const char* port :
       {"position.z", "velocity.x", "velocity.y", "velocity.z", "orientation.w", "orientation.x",
        "orientation.y", "orientation.z", "kinetic_energy", "potential_energy"})
    trails.push_back(prefix + port);
  std::size_t joints = 0, feet = 0;
  simulation::for_each_link(robot, [&](const simulation::TreeLink& at) {
    const std::string link = prefix + at.chain.name + "." + at.link.body.name + ".";
    if (!robot.mobile && joints++ < most_of_a_kind)
      trails.insert(trails.end(), {link + "angle", link + "rate"});
    if (experiment.terrain && at.is_last() && feet++ < most_of_a_kind)
      trails.push_back(link + "contact.force.z");
  });
  if (experiment.terrain && robot.chains.empty())
    trails.push_back(prefix + robot.base.name + ".contact.force.z");
  return trails;
}

}  // namespace hookpoint::view
