#include "simulation/engine_interface/drive_watch.h"

#include <fmt/format.h>

#include <cmath>

#include "simulation/experiment/robot_tree.h"

namespace hookpoint::simulation {
namespace {

/// Part of the velocity_limit from which it is met: some methods approach it over several steps.
constexpr double met = 0.999;

}  // namespace

DriveWatch::DriveWatch(const Experiment& experiment) {
  std::size_t joint = 0;
  for (const RobotSpec& robot : experiment.robots) {
    for_each_link(robot, [&](const TreeLink& at) {
      const std::string trail = robot.name + "." + at.chain.name + "." + at.link.body.name;
      const JointUnits& units = joint_type(at.link.joint).units;
      if (at.link.effort_limit)
        efforts_.push_back({joint, *at.link.effort_limit, trail, units.torque});
      if (at.link.velocity_limit)
        speeds_.push_back({joint, *at.link.velocity_limit, trail, units.rate});
      ++joint;
    });
  }
}

void DriveWatch::look(const WorldInputs& inputs, std::span<const JointState> joints, double time,
                      std::vector<std::string>& notices) {
  std::erase_if(efforts_, [&](const Limited& at) {
    const double asked = inputs.joint_torques[at.joint];
    if (!(std::abs(asked) > at.limit)) return false;
    notices.push_back(
        fmt::format("{:g} s: the drive of {} has to give {:.4g} {} and gives its effort_limit, "
                    "{:g} {} (reported once)",
                    time, at.trail, asked, at.unit, at.limit, at.unit));
    return true;
  });
  std::erase_if(speeds_, [&](const Limited& at) {
    const double asked = inputs.joint_torques[at.joint], rate = joints[at.joint].rate;
    if (!(asked * rate > 0.) || !(std::abs(rate) >= met * at.limit)) return false;
    notices.push_back(
        fmt::format("{:g} s: the drive of {} has to move it faster than its velocity_limit, {:g} "
                    "{}, and holds back what would (reported once)",
                    time, at.trail, at.limit, at.unit));
    return true;
  });
}

}  // namespace hookpoint::simulation
