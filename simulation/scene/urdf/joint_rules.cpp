#include "simulation/scene/urdf/joint_rules.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>

namespace hookpoint::simulation {

void fix_joint(double q, UrdfJoint& joint) {
  const double half = 0.5 * q;
  const Pose moved = joint.type == UrdfJointType::prismatic
                         ? Pose{q * joint.axis, {}}
                         : Pose{{},
                                {std::cos(half), std::sin(half) * joint.axis.x,
                                 std::sin(half) * joint.axis.y, std::sin(half) * joint.axis.z}};
  joint.origin = joint.origin * moved;
  joint.type = UrdfJointType::fixed;
  joint.fixed_at = q;
  joint.follows.reset();
}

double start_of(const UrdfJoint& joint) {
  double angle = joint.angle.value_or(0.);
  if (joint.lower_limit) angle = std::max(angle, *joint.lower_limit);
  return joint.upper_limit ? std::min(angle, *joint.upper_limit) : angle;
}

void settle_followers(UrdfRobot& robot, language::Report& report) {
  const auto find = [&](const std::string& name) {
    return std::ranges::find(robot.joints, name, &UrdfJoint::name);
  };
  for (UrdfJoint& joint : robot.joints) {
    std::size_t gears = 0;
    while (joint.follows) {
      UrdfFollows& follows = *joint.follows;
      const auto leader = find(follows.leader);
      if (leader == robot.joints.end() || leader->type == UrdfJointType::floating) {
        report.error(follows.place,
                     fmt::format("joint `{}` follows `{}`, and there is no such joint", joint.name,
                                 follows.leader));
        break;
      }
      if (leader->type == UrdfJointType::fixed) {
        fix_joint(follows.ratio * leader->fixed_at + follows.offset, joint);
        break;
      }
      if (!leader->follows) break;
      if (++gears > robot.joints.size()) {
        report.error(follows.place, fmt::format("joint `{}` follows others in a ring", joint.name));
        break;
      }
      follows.offset += follows.ratio * leader->follows->offset;
      follows.ratio *= leader->follows->ratio;
      follows.leader = leader->follows->leader;
    }
  }
}

}  // namespace hookpoint::simulation
