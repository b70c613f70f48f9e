#include "simulation/dts_engine/publish.h"

#include <array>

#include "math/pack_structures.h"

namespace hookpoint::simulation {
namespace {

/// The sign that a link's published quaternion has beside the one that follows from its rotation.
double sign_of(const Quaterniond& published, const Quaterniond& computed) {
  const double cosine = published.w * computed.w + published.x * computed.x +
                        published.y * computed.y + published.z * computed.z;
  return cosine < 0. ? -1. : 1.;
}

// The links of a group of chains side by side, as forward kinematics left them.
void publish_orientations(const ArticulatedRobot& robot, std::span<BodyState> bodies) {
  bodies[0].orientation = robot.state().base_orientation;
  for (const dts::ChainGroup<double>& group : robot.model().groups()) {
    for (std::size_t n = 0; n < group.link_count(); ++n) {
      const std::array<BodyState*, dts::lane_count> links = at_body(group, n, bodies);
      std::array<Quaterniond*, dts::lane_count> published;
      std::array<const Quaterniond*, dts::lane_count> last;
      for (std::size_t i = 0; i < links.size(); ++i)
        last[i] = published[i] = &links[i]->orientation;
      scatter(continued(quaternion_from(robot.workspace().links[group.first_pass + n].R_WB),
                        gather(last)),
              published);
    }
  }
}

}  // namespace

void publish_motion(const ArticulatedRobot& robot, std::span<BodyState> bodies) {
  for (std::size_t i = 0; i < bodies.size(); ++i) {
    const dts::BodyMotion<double>& body = robot.workspace().bodies[i];
    bodies[i].position = body.p_WB;
    bodies[i].velocity = body.v_WB;
    bodies[i].angular_velocity = body.w_WB;
    bodies[i].contact_force = {};
    bodies[i].contacts = 0;
  }
  publish_orientations(robot, bodies);
}

void publish_joints(const ArticulatedRobot& robot, std::span<JointState> joints) {
  for (std::size_t i = 0; i < joints.size(); ++i) {
    joints[i] = {robot.state().joint_positions[i], robot.state().joint_rates[i],
                 robot.workspace().joint_accelerations[i], robot.joint_torques()[i]};
  }
}

void publish_hips(const ArticulatedRobot& robot, std::span<ChainState> chains) {
  const auto& wrenches = robot.workspace().hip_wrenches;
  for (std::size_t i = 0; i < chains.size(); ++i)
    chains[i] = {wrenches[i].force, wrenches[i].moment};
}

void save_signs(const ArticulatedRobot& robot, std::span<const BodyState> bodies,
                std::span<double> signs) {
  for (std::size_t i = 1; i < bodies.size(); ++i)
    signs[i - 1] =
        sign_of(bodies[i].orientation, quaternion_from(robot.workspace().bodies[i].R_WB));
}

void restore_signs(const ArticulatedRobot& robot, std::span<const double> signs,
                   std::span<BodyState> bodies) {
  for (std::size_t i = 1; i < bodies.size(); ++i) {
    const double sign = signs[i - 1];
    const Quaterniond q = quaternion_from(robot.workspace().bodies[i].R_WB);
    bodies[i].orientation = {sign * q.w, sign * q.x, sign * q.y, sign * q.z};
  }
}

}  // namespace hookpoint::simulation
