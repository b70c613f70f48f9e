#include "simulation/dts_engine/robot_description.h"

#include "simulation/experiment/robot_tree.h"

namespace hookpoint::simulation {
namespace {

dts::MassProperties<double> mass_properties(const MassSpec& mass) {
  return {mass.mass, mass.center_of_mass, mass.inertia};
}

dts::LinkDescription describe_link(const LinkSpec& link) {
  const auto type =
      link.joint == JointKind::revolute ? dts::JointType::revolute : dts::JointType::prismatic;
  return {link.a,
          link.alpha,
          link.d,
          link.theta,
          type,
          mass_properties(link.body.mass),
          link.joint_location,
          link.joint_orientation,
          link.rotor_inertia};
}

}  // namespace

dts::RobotDescription describe_robot(const RobotSpec& robot) {
  dts::RobotDescription description{
      robot.mobile, mass_properties(robot.base.mass), {}, robot.plane_normal};
  for (const ChainSpec& chain : robot.chains) {
    dts::ChainDescription& added = description.chains.emplace_back();
    added.hip_position = chain.hip_distance;
    added.hip_orientation = chain.hip_orientation;
    added.carrier = chain.carrier;
    for (const LinkSpec& link : chain.links) added.links.push_back(describe_link(link));
  }
  return description;
}

dts::State<double> initial_state(const RobotSpec& robot) {
  dts::State<double> state{robot.location, robot.orientation, {}, {}, {}, {}};
  if (robot.mobile) {
    state.base_velocity = robot.velocity;
    state.base_angular_velocity = robot.angular_velocity;
  }
  for_each_link(robot, [&](const TreeLink& at) {
    state.joint_positions.push_back(at.link.angle);
    state.joint_rates.push_back(at.link.rate);
  });
  return state;
}

}  // namespace hookpoint::simulation
