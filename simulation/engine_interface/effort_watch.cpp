#include "simulation/engine_interface/effort_watch.h"

#include <fmt/format.h>

#include <cmath>

#include "simulation/experiment/robot_tree.h"

namespace hookpoint::simulation {

EffortWatch::EffortWatch(const Experiment& experiment) {
  std::size_t joint = 0;
  for (const RobotSpec& robot : experiment.robots) {
    for_each_link(robot, [&](const TreeLink& at) {
      if (at.link.effort_limit)
        limited_.push_back({joint, *at.link.effort_limit,
                            robot.name + "." + at.chain.name + "." + at.link.body.name,
                            joint_type(at.link.joint).units.torque});
      ++joint;
    });
  }
}

void EffortWatch::look(const WorldInputs& inputs, double time, std::vector<std::string>& notices) {
  std::erase_if(limited_, [&](const Limited& at) {
    const double asked = inputs.joint_torques[at.joint];
    if (!(std::abs(asked) > at.limit)) return false;
    notices.push_back(
        fmt::format("{:g} s: the drive of {} has to give {:.4g} {} and gives its effort_limit, "
                    "{:g} {} (reported once)",
                    time, at.trail, asked, at.unit, at.limit, at.unit));
    return true;
  });
}

}  // namespace hookpoint::simulation
